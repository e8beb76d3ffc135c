// What happened to a face, as far as the comparison of all faces proves it together with the names
// that the files give them.
import { type DiffResult, type FaceDifference, facePath } from "nurbs-hausdorff";
import type { PlacedPart, Side } from "../worker/protocol.ts";

/**
 * `extended`: all of the other model's face of that name is within the limit, so that nothing of it
 * is gone and this one reaches beyond; of A that is `shortened` in B. `added` in B or `removed` from
 * A: the other file has no face of that name, or its part has no partner there. `moved`: of a part that is
 * proven to be the other model's after a motion, or a round face whose axis is elsewhere. `resized`: a round face
 * whose radius is another one, also if it moved. `changed` is all that is beyond and none of these.
 */
export type Kind =
  | "unchanged"
  | "changed"
  | "extended"
  | "shortened"
  | "added"
  | "removed"
  | "moved"
  | "resized"
  | "undecided";

/** Names that stand for none: the number of the face. */
const UNNAMED = /^(face|surface|triangle|point)?\s*#?\d*$/i;

/** Returns what happened to each face of a model, of whose parts is known what became of them. O(n). */
export function kindsOf(
  { facesOfA, facesOfB }: DiffResult,
  side: Side,
  parts: readonly PlacedPart[] = [],
): Kind[] {
  const partsThatAre = (which: PlacedPart["state"]) =>
    new Set(parts.flatMap(({ state, facesOf }) => (state === which ? facesOf[side] : [])));
  const isOnlyHere = side === "a" ? "removed" : "added";
  const [moved, single] = [partsThatAre("moved"), partsThatAre(isOnlyHere)];
  const [own, other] = side === "a" ? [facesOfA, facesOfB] : [facesOfB, facesOfA];
  const [ownNames, otherNames] = [countedNames(own, side), countedNames(other, otherSide(side))];
  const states = new Map(other.map((one) => [nameOf(one, otherSide(side)), one.state]));
  // Numbers of faces do not tell which faces are new.
  const isNamed = [...otherNames.keys()].some(isOwnName);
  return own.map((difference) => {
    const name = nameOf(difference, side);
    if (difference.state !== "changed") return difference.state;
    if (moved.has(difference.face)) return "moved";
    const change = difference.counterpart?.change;
    if (change !== undefined) return change === "moved" ? "moved" : "resized";
    if (single.has(difference.face)) return isOnlyHere;
    if (name === undefined || ownNames.get(name) !== 1) return "changed";
    const count = otherNames.get(name) ?? 0;
    if (count === 0 && isNamed && isOwnName(name)) return isOnlyHere;
    if (count !== 1 || states.get(name) !== "unchanged") return "changed";
    return side === "a" ? "shortened" : "extended";
  });
}

/** Whether a face is the other model's and more, or less of it. */
export const isOfSamePlace = (kind: Kind): boolean => kind === "extended" || kind === "shortened";

const otherSide = (side: Side): Side => (side === "a" ? "b" : "a");

/** The name that a file gives a face; undefined without one. */
function nameOf({ witness }: FaceDifference, side: Side): string | undefined {
  const name = witness[side].faceName;
  return name === undefined || UNNAMED.test(name) ? undefined : name;
}

/** Whether a name is more than the number of a face in its part. */
const isOwnName = (name: string): boolean => !UNNAMED.test(facePath(name).at(-1) ?? "");

/** How many faces have each name. */
function countedNames(all: readonly FaceDifference[], side: Side): Map<string, number> {
  const counts = new Map<string, number>();
  for (const one of all) {
    const name = nameOf(one, side);
    if (name !== undefined) counts.set(name, (counts.get(name) ?? 0) + 1);
  }
  return counts;
}
