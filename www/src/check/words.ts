// The words of a check: its verdict, its pairs and its bodies.

import {
  type BodyPair,
  type CheckedBody,
  type CheckResult,
  facePath,
  type UnkeptRule,
} from "nurbs-hausdorff";
import { grouped } from "../common/text/numbers.ts";
import { listedQuantity, narrowText, shownQuantity } from "../common/text/quantities.ts";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";

/** The first line: what is certain of all pairs. */
export function verdictText(result: CheckResult): string {
  const { bodies, pairCount, pairs } = result;
  const crossed = bodies.filter((body) => body.selfOverlap !== null).length;
  const faults = crossed > 0 ? texts.bodies.meetThemselves(crossed) : "";
  if (bodies.length === 1) return `${texts.bodies.oneBodyItHasNothing}${faults}`;
  const of = (state: BodyPair["state"]) => pairs.filter((pair) => pair.state === state);
  const count = (state: BodyPair["state"]) => of(state).filter((pair) => !pair.intended).length;
  const meant = of("clash").filter((pair) => pair.intended).length;
  const all = texts.bodies.pairs(grouped(pairCount), pairCount);
  const [clashes, undecided] = [count("clash"), count("undecided")];
  const others = [
    ...(undecided > 0 && clashes > 0 ? [texts.bodies.undecided(undecided)] : []),
    texts.bodies.touching(count("touching")),
    texts.bodies.near(count("near")),
    ...(meant > 0 ? [texts.bodies.meantCount(meant)] : []),
  ].join(", ");
  if (clashes > 0) return texts.bodies.clashOf(clashes, all, others);
  const broken = result.rules.filter((rule) => rule.broken).length;
  if (broken > 0) return texts.bodies.rulesBroken(broken, others);
  const open = result.rules.length;
  if (open > 0) return texts.bodies.rulesUndecided(open, others);
  if (undecided > 0) return texts.bodies.undecidedOf(undecided, all, others);
  return `${texts.bodies.clean(all, others)}${faults}`;
}

/** The width of a depth, which is often known from one side only, up to which one number stands for it. */
const DEPTH_WIDTH = 0.01;

/** How near the bodies of a pair come, or how deep they are in each other; `scale` is the scene's units in one of the check's. */
export function pairText(
  { state, clearance, depth, volume, why }: BodyPair,
  scale: number,
): string {
  const unit = commonUnit();
  const of = (power: string) => (unit === undefined ? "" : ` ${unit}${power}`);
  if (state === "clash") {
    const deep =
      depth === null
        ? []
        : [texts.bodies.depth(narrowText(shownQuantity(depth, 1, scale), DEPTH_WIDTH), of(""))];
    const large =
      volume === null
        ? []
        : [texts.bodies.volume(listedQuantity(shownQuantity(volume, 3, scale)), of("³"))];
    return [...deep, ...large].join(", ");
  }
  const apart = texts.bodies.apart(listedQuantity(shownQuantity(clearance, 1, scale)), of(""));
  return state === "undecided" && why !== undefined ? `${apart}: ${why}` : apart;
}

/** What is not certainly as a rule asks for. */
export function unkeptText(
  { rule, broken, distance, clearance }: UnkeptRule,
  scale: number,
): string {
  const found =
    clearance === undefined
      ? ""
      : `, ${listedQuantity(shownQuantity(clearance, 1, scale))} ${commonUnit() ?? ""}`.trimEnd();
  const what =
    rule === "mustTouch" ? texts.bodies.touchesNoneOf : texts.bodies.nearerThan(distance ?? 0);
  return texts.bodies.unkept(broken, `${what}${found}`);
}

/** What is wrong with a body by itself. */
export function faultsOf(
  { closed, orientation, degenerate, selfOverlap, duplicates }: CheckedBody,
  isOfBoth: boolean,
): string[] {
  return [
    ...(closed ? [] : [texts.bodies.open]),
    ...(orientation === "insideOut" ? [texts.bodies.insideOut] : []),
    ...(orientation === "mixed" ? [texts.bodies.facesTurnedOver] : []),
    ...(orientation === "notOrientable" ? [texts.bodies.noSidesThatAgree] : []),
    ...(degenerate ? [texts.bodies.noInsideWithinTheTolerance] : []),
    ...(selfOverlap === null ? [] : [texts.bodies.meetsItself]),
    ...(duplicates.length > 0
      ? [texts.bodies.duplicateOf(duplicates.map((name) => shortName(name, isOfBoth)).join(", "))]
      : []),
  ];
}

/** The last level of a body's name, of both models together with the letter of its model. */
export function shortName(name: string, isOfBoth: boolean): string {
  const levels = facePath(name);
  const last = levels.at(-1) ?? name;
  return isOfBoth && levels.length > 1 ? `${levels[0]} ${last}` : last;
}
