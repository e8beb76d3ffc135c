// The options of a measurement that are set in the panel.
import type { IterationOptions } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import type { Overlays } from "../scene/shown/display.ts";
import { type PlainOptions, SIDES, type Side } from "../worker/protocol.ts";

type Flatness = NonNullable<IterationOptions["flatness"]>;

const input = (id: string) => element(id, HTMLInputElement);
const select = (id: string) => element(id, HTMLSelectElement);

const [samples, samplesText] = [input("samples"), element("samples-text")];
const [method, tolerance, flatness] = [select("method"), select("tolerance"), select("flatness")];
const [symmetric, triangles] = [input("symmetric"), input("triangles")];
const [deviation, lines, painted] = [input("deviation"), input("lines"), select("paint")];

/** What is drawn in addition to the models. */
export const overlays = (): Overlays => ({
  deviation: deviation.checked,
  lines: lines.checked,
  triangles: triangles.checked,
});

/** The models whose deviations are mapped. */
export function paint(): readonly Side[] {
  if (!deviation.checked && !lines.checked) return [];
  return painted.value === "both" ? SIDES : [painted.value as Side];
}

/** The options of a measurement except the transform. */
export function distanceOptions(): PlainOptions {
  const common = { relativeTolerance: Number(tolerance.value), symmetric: symmetric.checked };
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
}

/** Calls back on every change of an option. */
export function onChange(callback: () => void): void {
  const changed = () => {
    showApplicable();
    callback();
  };
  for (const control of [
    ...[samples, method, tolerance, flatness],
    ...[symmetric, deviation, lines, triangles, painted],
  ]) {
    control.addEventListener("input", changed);
  }
  showApplicable();
}

/** Hides the options that do not apply to the chosen method. */
function showApplicable(): void {
  samplesText.textContent = `${samples.value}²`;
  const applicable = [method.value];
  for (const row of document.querySelectorAll<HTMLElement>("[data-methods]")) {
    row.hidden = !row.dataset.methods?.split(" ").some((name) => applicable.includes(name));
  }
}
