// A line below the directions where one model is points: what else than the points is judged, and how it is not.

import { effect, signal } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { field, isOn } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";

const symmetric = field("symmetric");
const note = element("scan-note");
/** Whether each model is points. */
const clouds = signal<Sides<boolean>>({});

effect(() => {
  const text = textOf(clouds.value, isOn(symmetric));
  note.textContent = text;
  note.hidden = text === "";
});

/** Heeds which of the models that were loaded are points. */
export function showScanNote(models: Sides<DisplayModel>): void {
  const next = { ...clouds.value };
  for (const side of SIDES) {
    const model = models[side];
    if (model !== undefined) next[side] = model.isMesh && model.tessellation.indices.length === 0;
  }
  clouds.value = next;
}

/** Between points that are sparse a surface is far from all of them, however well it was scanned. */
function textOf({ a = false, b = false }: Sides<boolean>, isBothWays: boolean): string {
  if (a === b) return "";
  const side: Side = a ? "a" : "b";
  if (side === "b") return texts.files.scanIsB(isBothWays);
  return isBothWays ? texts.files.scanIsA : "";
}
