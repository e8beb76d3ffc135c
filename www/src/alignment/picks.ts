// What is picked to lay A on B: points of A with the points of B where they belong, or faces with faces.

import { computed, signal } from "@preact/signals-core";
import type { Datum, PointPair, Vector3 } from "nurbs-hausdorff";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";

/** What a pick is of: a point, or the face that it is on. */
export type PickKind = "points" | "faces";

export interface Pick {
  side: Side;
  face: number;
  /** In the model's own coordinates. */
  point: Vector3;
}

/** Points that determine a motion, and faces that may: a datum of three, the primary first. */
const NEEDED: Readonly<Record<PickKind, number>> = { points: 3, faces: 1 };
const MOST: Readonly<Record<PickKind, number>> = { points: 20, faces: 3 };

export const kind = signal<PickKind>("points");

/** All picks: one of A, then one of B, and so on. */
export const picks = signal<readonly Pick[]>([]);

/** The side that the next pick is of. */
export const nextSide = computed((): Side => (picks.value.length % 2 === 0 ? "a" : "b"));

/** The complete pairs. */
const pairs = computed((): readonly (readonly [Pick, Pick])[] =>
  picks.value.flatMap((a, index) => {
    const b = picks.value[index + 1];
    return index % 2 === 0 && b !== undefined ? [[a, b] as const] : [];
  }),
);

/** Whether there are enough pairs to lay A on B. */
export const isEnough = computed(() => pairs.value.length >= NEEDED[kind.value]);

/** What the user is asked for. */
export const asked = computed((): string => {
  const { length } = pairs.value;
  const what = texts.places.picked[kind.value];
  if (length >= MOST[kind.value]) return texts.places.pairsAreTheMostLay(length);
  if (nextSide.value === "b") return texts.places.clickThatOfB(what);
  const missing = NEEDED[kind.value] - length;
  const more = missing > 0 ? texts.places.morePairsNeeded(missing) : "";
  return texts.places.clickOneOfA(what, more).trim();
});

/** Adds a pick of the side that is asked for; returns whether it is one. */
export function addPick(pick: Pick): boolean {
  const isFull = pairs.value.length >= MOST[kind.value];
  if (pick.side !== nextSide.value || isFull) return false;
  picks.value = [...picks.value, pick];
  return true;
}

/** Removes the last pick. */
export function removeLast(): void {
  picks.value = picks.value.slice(0, -1);
}

/** The pairs as a fit takes them; `scale` is A's units in one of B's. */
export function fitStart(scale: number): { pairs: PointPair[] } | { datums: Datum[] } {
  const all = pairs.value;
  if (kind.value === "faces") {
    const of = ({ face }: Pick) => ({ face: { index: face } });
    return { datums: all.map(([a, b]) => ({ a: of(a), b: of(b) })) };
  }
  const scaled = ([x, y, z]: Vector3): Vector3 => [scale * x, scale * y, scale * z];
  return { pairs: all.map(([a, b]) => ({ a: a.point, b: scaled(b.point) })) };
}
