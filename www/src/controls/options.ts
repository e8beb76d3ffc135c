// The options of a measurement that are set in the panel.
import { element } from "../common/elements.ts";
import type { Overlays } from "../scene/view.ts";
import type { PlainOptions } from "../worker/protocol.ts";

const input = (id: string) => element(id, HTMLInputElement);
const select = (id: string) => element(id, HTMLSelectElement);

const [samples, samplesText] = [input("samples"), element("samples-text")];
const [method, tolerance, flatness] = [select("method"), select("tolerance"), select("flatness")];
const [symmetric, triangles] = [input("symmetric"), input("triangles")];
const [deviation, lines] = [input("deviation"), input("lines")];

/** What is drawn in addition to the models. */
export const overlays = (): Overlays => ({
  deviation: deviation.checked,
  lines: lines.checked,
  triangles: triangles.checked,
});

const needsField = (): boolean => deviation.checked || lines.checked;

/** The options of a measurement except the transform. */
export function distanceOptions(): PlainOptions {
  return {
    method: method.value as PlainOptions["method"],
    relativeTolerance: Number(tolerance.value),
    samples: Number(samples.value),
    flatness: flatness.value as PlainOptions["flatness"],
    symmetric: symmetric.checked,
    deviations: needsField(),
  };
}

/** Calls back on every change of an option. */
export function onChange(callback: () => void): void {
  const changed = () => {
    showApplicable();
    callback();
  };
  for (const control of [
    ...[samples, method, tolerance, flatness],
    ...[symmetric, deviation, lines, triangles],
  ]) {
    control.addEventListener("input", changed);
  }
  showApplicable();
}

/** Hides the options that do not apply to the chosen method. */
function showApplicable(): void {
  samplesText.textContent = `${samples.value}²`;
  const applicable = [method.value, needsField() ? "field" : ""];
  for (const row of document.querySelectorAll<HTMLElement>("[data-methods]")) {
    row.hidden = !row.dataset.methods?.split(" ").some((name) => applicable.includes(name));
  }
}
