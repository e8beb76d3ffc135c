// The exploded view: its switch, how far bodies are moved, and what is said of it.

import { computed, effect, signal } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { field, onChange } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import type { Sides } from "../worker/protocol.ts";

const switched = field("explode");
const at = field("explode-at");
/** The number of bodies of the model that has most; undefined until it is known. */
const count = signal<number | undefined>(undefined);

/** How far bodies are moved apart: from 0, where they stand, to 1. */
export const exploded = computed((): number => {
  const part = Number(at.value);
  return switched.value === "on" && Number.isFinite(part) ? Math.min(1, Math.max(0, part)) : 0;
});

/** Calls back on every change, and with `ask` when the bodies have to be known. */
export function onExplode(callback: () => void, ask: () => void): void {
  effect(() => {
    element("explode-controls").hidden = switched.value !== "on";
    element("explode-note").textContent = noteOf(count.value);
  });
  onChange(
    () => switched.value,
    () => {
      if (switched.value === "on" && count.peek() === undefined) ask();
    },
  );
  onChange(() => exploded.value, callback);
}

function noteOf(bodies: number | undefined): string {
  if (bodies === undefined) return texts.files.findingTheBodies;
  if (bodies < 2) return texts.files.oneBodyEach;
  return texts.files.toLookAtOnly;
}

/** Notes the bodies of the models; without them, they have to be asked for again. */
export function setBodies(faces: Sides<readonly unknown[]> | undefined): void {
  count.value =
    faces && Object.values(faces).reduce((most, { length }) => Math.max(most, length), 0);
}

/** Whether bodies have to be known, which are not. */
export const needsBodies = (): boolean => switched.value === "on" && count.value === undefined;

/** Puts bodies together again. */
export const assemble = (): void => switched.set("");
