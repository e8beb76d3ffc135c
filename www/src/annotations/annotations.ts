// Texts at points of the models: in a control of the form, so that links, undoing and kept files hold them.
import { computed } from "@preact/signals-core";
import type { Vector3 } from "nurbs-hausdorff";
import { field } from "../state/store.ts";
import { SIDES, type Side } from "../worker/protocol.ts";

/** The longest text, and the most annotations: a link holds them. */
export const MAX_TEXT = 300;
const MAX_COUNT = 60;
/** Significant digits of a point. */
const DIGITS = 9;

export interface Annotation {
  side: Side;
  face: number;
  /** In the model's own coordinates: it moves with the model. */
  point: Vector3;
  text: string;
}

const state = field("annotations");

/** All annotations, in the order in which they were made: their numbers are from 1. */
export const annotations = computed((): readonly Annotation[] => parsed(state.value));

/** Adds an annotation, and returns its index; undefined where there is no room for another one. */
export function addAnnotation(annotation: Annotation): number | undefined {
  const all = annotations.peek();
  if (all.length >= MAX_COUNT) return undefined;
  write([...all, annotation]);
  return all.length;
}

/** Changes the text of an annotation; one without a text is removed. */
export function setAnnotationText(index: number, text: string): void {
  const cut = text.trim().slice(0, MAX_TEXT);
  const all = [...annotations.peek()];
  const own = all[index];
  if (own === undefined) return;
  if (cut === "") all.splice(index, 1);
  else all[index] = { ...own, text: cut };
  write(all);
}

export const removeAnnotation = (index: number): void => setAnnotationText(index, "");

/** Removes all of them: the models are new. */
export const clearAnnotations = (): void => state.set("");

function write(all: readonly Annotation[]): void {
  const rows = all.map(({ side, face, point, text }) => [
    ...[side, face, ...point.map((at) => Number(at.toPrecision(DIGITS)))],
    text,
  ]);
  state.set(rows.length === 0 ? "" : JSON.stringify(rows));
}

/** What a link says, which may be anything. */
function parsed(text: string): Annotation[] {
  if (text === "") return [];
  let rows: unknown;
  try {
    rows = JSON.parse(text);
  } catch {
    return [];
  }
  return Array.isArray(rows) ? rows.slice(0, MAX_COUNT).flatMap(annotationOf) : [];
}

function annotationOf(row: unknown): Annotation[] {
  if (!Array.isArray(row)) return [];
  const [side, face, x, y, z, text] = row as unknown[];
  const isPoint = [face, x, y, z].every((value) => Number.isFinite(value));
  const isKnown = SIDES.some((one) => one === side);
  if (!isPoint || !isKnown || typeof text !== "string" || text.trim() === "") return [];
  const point = [x, y, z] as unknown as Vector3;
  return [{ side: side as Side, face: Number(face), point, text: text.slice(0, MAX_TEXT) }];
}
