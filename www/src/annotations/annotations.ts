// Texts at points of the models, in a list that links, undoing and kept files hold.
import type { Vector3 } from "nurbs-hausdorff";
import { keptList, short } from "../state/keptList.ts";
import { SIDES, type Side } from "../worker/protocol.ts";

/** The longest text: a link holds it. */
export const MAX_TEXT = 300;

export interface Annotation {
  side: Side;
  face: number;
  /** In the model's own coordinates: it moves with the model. */
  point: Vector3;
  text: string;
}

const list = keptList("annotations", rowOf, annotationOf);

/** All annotations, in the order in which they were made: their numbers are from 1. */
export const annotations = list.all;

/** Whether there is room for another one. */
export const mayAnnotate = list.hasRoom;

/** Adds an annotation, and returns its index; undefined where there is no room for another one. */
export const addAnnotation = list.add;

/** Changes the text of an annotation; one without a text is removed. */
export function setAnnotationText(index: number, text: string): void {
  const cut = text.trim().slice(0, MAX_TEXT);
  const all = [...annotations.peek()];
  const own = all[index];
  if (own === undefined) return;
  if (cut === "") all.splice(index, 1);
  else all[index] = { ...own, text: cut };
  list.write(all);
}

export const removeAnnotation = (index: number): void => setAnnotationText(index, "");

/** Removes all of them: the models are new. */
export const clearAnnotations = (): void => list.write([]);

function rowOf({ side, face, point, text }: Annotation): unknown[] {
  return [side, face, ...point.map(short), text];
}

function annotationOf(row: readonly unknown[]): Annotation | undefined {
  const [side, face, x, y, z, text] = row;
  const isPoint = [face, x, y, z].every((value) => Number.isFinite(value));
  const isKnown = SIDES.some((one) => one === side);
  if (!isPoint || !isKnown || typeof text !== "string" || text.trim() === "") return undefined;
  const point = [x, y, z] as unknown as Vector3;
  return { side: side as Side, face: Number(face), point, text: text.slice(0, MAX_TEXT) };
}
