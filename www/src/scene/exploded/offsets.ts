// How far bodies are moved apart: from the middle of all, and those of both models that are one body alike.
import { Box3, Vector3 } from "three";
import type { Side, Sides } from "../../worker/protocol.ts";

/** The way of a body whose middle is on the edge of all, in distances of that from the middle of all. */
const SPREAD = 1.6;
/** The least part that the boxes of two bodies have in common, of both together, that are one body in two revisions. */
const ALIKE = 0.5;

/** A body's box in the scene. */
export interface BodyBox {
  side: Side;
  box: Box3;
}

/**
 * Returns the ways of bodies in the scene, in their order: `part` is from 0, where all stay, to 1. A body of A
 * goes with the body of B that it is a revision of, so that both are seen over each other still. O(ab).
 */
export function waysOf(bodies: readonly BodyBox[], part: number): Vector3[] {
  const all = bodies.reduce((box, { box: one }) => box.union(one), new Box3());
  const middle = all.getCenter(new Vector3());
  const own = bodies.map(({ box }) => box.getCenter(new Vector3()).sub(middle));
  const others = [...bodies.entries()].filter(([, { side }]) => side === "b");
  return bodies.map(({ side, box }, index) => {
    const alike = side === "b" ? undefined : likest(box, others);
    const way = own[alike ?? index] ?? new Vector3();
    return way.clone().multiplyScalar(SPREAD * part);
  });
}

/** The index of the body whose box has most in common with this one, if that is enough. */
function likest(box: Box3, others: readonly (readonly [number, BodyBox])[]): number | undefined {
  let best = ALIKE;
  let found: number | undefined;
  for (const [index, { box: other }] of others) {
    const common = box.clone().intersect(other);
    const size = common.isEmpty() ? 0 : volume(common);
    const part = size / (volume(box) + volume(other) - size || 1);
    if (part < best) continue;
    best = part;
    found = index;
  }
  return found;
}

function volume(box: Box3): number {
  const { x, y, z } = box.getSize(new Vector3());
  return x * y * z;
}

/** The faces of the bodies of both models, by their index in their model. */
export type BodyFaces = Sides<readonly (readonly number[])[]>;
