// The faces that a comparison found changed or undecided, and their numbers.
import type { DiffResult, FaceDifference, FaceState } from "nurbs-hausdorff";
import type { FaceClass } from "../scene/faces.ts";
import { type PlacedPart, SIDES, type Side } from "../worker/protocol.ts";
import { isOfSamePlace, type Kind, kindsOf } from "./kinds.ts";

/** One face of one of the models. */
export interface Change {
  side: Side;
  difference: FaceDifference;
  kind: Kind;
}

/** Returns the faces of one model, in order. */
export const facesOf = ({ facesOfA, facesOfB }: DiffResult, side: Side): FaceDifference[] =>
  side === "a" ? facesOfA : facesOfB;

/**
 * Returns the changed faces of both models, the largest lower bound first, after them those that
 * were only extended or shortened, and the undecided ones at last.
 */
export function changesOf(result: DiffResult, parts: readonly PlacedPart[] = []): Change[] {
  const all = SIDES.flatMap((side) => {
    const kinds = kindsOf(result, side, parts);
    return facesOf(result, side)
      .map((difference, index) => ({ side, difference, kind: kinds[index] ?? difference.state }))
      .filter(({ kind }) => kind !== "unchanged");
  });
  const rank = ({ kind }: Change) => (kind === "undecided" ? 2 : isOfSamePlace(kind) ? 1 : 0);
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

/** Returns the class in which a face is drawn: coloured unless unchanged. */
export function classOf(kind: Kind): FaceClass {
  if (kind === "unchanged") return "plain";
  if (kind === "undecided") return "undecided";
  return isOfSamePlace(kind) ? "extended" : "changed";
}

/** Returns the classes in which the faces of a model are drawn. */
export const classesOf = (result: DiffResult, side: Side): FaceClass[] =>
  kindsOf(result, side).map(classOf);
