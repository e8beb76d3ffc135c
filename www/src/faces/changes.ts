// The faces that a comparison found changed or undecided, and their numbers.
import type { DiffResult, FaceDifference, FaceState } from "nurbs-hausdorff";
import type { FaceClass } from "../scene/faces.ts";
import { SIDES, type Side } from "../worker/protocol.ts";

/** One face of one of the models. */
export interface Change {
  side: Side;
  difference: FaceDifference;
}

/** Returns the faces of one model, in order. */
export const facesOf = ({ facesOfA, facesOfB }: DiffResult, side: Side): FaceDifference[] =>
  side === "a" ? facesOfA : facesOfB;

/** Returns the changed faces of both models, the largest lower bound first, and after them the undecided ones. */
export function changesOf(result: DiffResult): Change[] {
  const all = SIDES.flatMap((side) =>
    facesOf(result, side)
      .filter(({ state }) => state !== "unchanged")
      .map((difference) => ({ side, difference })),
  );
  const rank = ({ difference }: Change) => (difference.state === "changed" ? 0 : 1);
  return all.sort(
    (one, two) => rank(one) - rank(two) || two.difference.lower - one.difference.lower,
  );
}

/** Returns the number of faces in each state. */
export function countsOf(differences: FaceDifference[]): Record<FaceState, number> {
  const counts = { unchanged: 0, changed: 0, undecided: 0 };
  for (const { state } of differences) counts[state] += 1;
  return counts;
}

/** Returns the class in which each face is drawn: coloured unless unchanged. */
export function classesOf(differences: FaceDifference[]): FaceClass[] {
  return differences.map(({ state }) => (state === "unchanged" ? "plain" : state));
}
