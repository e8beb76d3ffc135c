// The options and the position of A that are set in the panel.
import { Vector3 } from "three";
import { element } from "../common/elements.ts";
import type { Overlays } from "../scene/view.ts";
import type { Placement, PlainOptions } from "../worker/protocol.ts";
import { NumberInput } from "./numberInput.ts";

const input = (id: string) => element(id, HTMLInputElement);
const select = (id: string) => element(id, HTMLSelectElement);

const [x, y, z] = [new NumberInput("move-x"), new NumberInput("move-y"), new NumberInput("move-z")];
const rotation = new NumberInput("turn");
const [samples, samplesText] = [input("samples"), element("samples-text")];
const [method, tolerance, flatness] = [select("method"), select("tolerance"), select("flatness")];
const [symmetric, triangles] = [input("symmetric"), input("triangles")];
const [deviation, lines] = [input("deviation"), input("lines")];

/** The translation of A, in model units. */
export const translation = (): Vector3 => new Vector3(x.value, y.value, z.value);

/** The rotation of A about its vertical axis, in degrees. */
export const rotationDegrees = (): number => rotation.value;

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
    method: method.value as NonNullable<PlainOptions["method"]>,
    tolerance: Number(tolerance.value),
    samples: Number(samples.value),
    flatness: flatness.value as NonNullable<PlainOptions["flatness"]>,
    symmetric: symmetric.checked,
    field: needsField(),
  };
}

/** Shows the position of A. `diagonal` converts the placement to model units. */
export function setPlacement(placement: Placement, diagonal: number): void {
  [x, y, z].forEach((input, axis) => {
    input.unit = diagonal;
    input.value = (placement.move[axis] ?? 0) * diagonal;
  });
  rotation.value = placement.turn;
}

/** Calls back on every change of an option or of the position; `moved` states which. */
export function onChange(callback: (moved: boolean) => void): void {
  const changed = () => {
    showApplicable();
    callback(false);
  };
  for (const input of [x, y, z, rotation]) input.onChange = () => callback(true);
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
