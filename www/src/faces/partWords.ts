// What became of parts, in words.

import { facePath } from "nurbs-hausdorff";
import { boundText, distanceText } from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";
import type { PlacedPart } from "../worker/protocol.ts";

type State = PlacedPart["state"];
type Motion = NonNullable<PlacedPart["motion"]>;

/** The words of states: in the tree, in lists and in the summary. */
export const WORDS: Record<State, string> = texts.faces.partStates;

/** The angle in degrees, and the relative length across an axis, up to which a part is not turned or skew. */
const NO_TURN = 1e-6;
/** Lengths below this part of the diagonal are no way. */
const NO_WAY = 1e-9;

/** What became of a part beyond its word: its motion, its new name, its faces that changed. */
export function detailText(part: PlacedPart, diagonal: number): string {
  const { state, motion, faces, upper, nameOfB } = part;
  const details: string[] = [];
  if (state === "renamed") details.push(texts.faces.to(nameOfB ?? ""));
  if (motion !== null && (state === "moved" || state === "movedAndChanged")) {
    details.push(motionText(motion, diagonal));
  }
  if (state === "changed" || state === "movedAndChanged") {
    const count = Math.max(faces.ofA.length, faces.ofB.length);
    const most = upper === null ? "" : texts.faces.atMost(boundText(upper, diagonal), unitText());
    details.push(`${texts.files.faces(`${count}`, count)}${most}`);
  }
  return details.join("; ");
}

const unitText = (): string => {
  const unit = commonUnit();
  return unit === undefined ? "" : ` ${unit}`;
};

function motionText({ shift, angle, axis }: Motion, diagonal: number): string {
  const way = Math.hypot(...shift);
  const turn =
    angle > NO_TURN ? [texts.faces.turnedByAbout(angle.toFixed(3), direction(axis))] : [];
  const move =
    way > NO_WAY * diagonal
      ? [texts.faces.byAlong(distanceText(way, diagonal), unitText(), direction(shift))]
      : [];
  return [...turn, ...move].join(", ");
}

/** The name of an axis, or two digits of each coordinate. */
function direction(of: readonly [number, number, number]): string {
  const length = Math.hypot(...of);
  for (const [at, name] of ["x", "y", "z"].entries()) {
    const along = (of[at] ?? 0) / length;
    if (1 - Math.abs(along) <= NO_TURN ** 2) return `${along < 0 ? "−" : ""}${name}`;
  }
  return of.map((one) => (one / length).toFixed(2).replace("-", "−")).join(" ");
}

/** The line above the list: how many parts are not the same, and what became of them. */
export function partsSummary(parts: readonly PlacedPart[]): string {
  const others = parts.filter(({ state }) => state !== "same");
  if (others.length === 0) return texts.faces.allPartsAreTheSame(parts.length);
  const counts = new Map<State, number>();
  for (const { state } of others) counts.set(state, (counts.get(state) ?? 0) + 1);
  const words = (Object.keys(WORDS) as State[]).flatMap((state) => {
    const count = counts.get(state);
    return count === undefined ? [] : [`${count} ${WORDS[state]}`];
  });
  return texts.faces.partsAreNotTheSame(others.length, parts.length, words.join("; "));
}

/** A part's name for lists: its last level in A, else in B. */
export const partName = ({ nameOfA, nameOfB }: PlacedPart): string =>
  facePath(nameOfA ?? nameOfB ?? "").at(-1) ?? "";
