// The options of a measurement that are set in the panel.
import { computed, effect } from "@preact/signals-core";
import type { IterationOptions } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import type { Overlays } from "../scene/shown/display.ts";
import { field, isOn, onChange } from "../state/store.ts";
import { type PlainOptions, SIDES, type Side } from "../worker/protocol.ts";

type Flatness = NonNullable<IterationOptions["flatness"]>;

const [method, tolerance, samples] = [field("method"), field("tolerance"), field("samples")];
const [flatness, symmetric, painted] = [field("flatness"), field("symmetric"), field("paint")];
const [deviation, lines, triangles] = [field("deviation"), field("lines"), field("triangles")];

/** What is drawn in addition to the models. */
export const overlays = computed(
  (): Overlays => ({
    deviation: isOn(deviation),
    lines: isOn(lines),
    triangles: isOn(triangles),
  }),
);

/** The models whose deviations are mapped. */
export const paint = computed((): readonly Side[] => {
  if (!isOn(deviation) && !isOn(lines)) return [];
  return painted.value === "both" ? SIDES : [painted.value as Side];
});

/** The options of a measurement except the transform. */
export const distanceOptions = computed((): PlainOptions => {
  const common = { relativeTolerance: Number(tolerance.value), symmetric: isOn(symmetric) };
  switch (method.value) {
    case "iteration":
      return {
        ...common,
        ...{ method: "iteration", samples: Number(samples.value) },
        flatness: flatness.value as Flatness,
      };
    case "hierarchy":
      return { ...common, method: "hierarchy" };
    default:
      return { ...common, method: "certified" };
  }
});

/** Calls back on every change of an option, and once where several change together. */
export function onOptions(callback: () => void): void {
  effect(showApplicable);
  onChange(() => [distanceOptions.value, overlays.value, paint.value], callback);
}

/** Hides the options that do not apply to the chosen method. */
function showApplicable(): void {
  element("samples-text").textContent = `${samples.value}²`;
  for (const row of document.querySelectorAll<HTMLElement>("[data-methods]")) {
    row.hidden = !row.dataset.methods?.split(" ").includes(method.value);
  }
}
