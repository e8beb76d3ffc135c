// What the user chose in the panel.
import { Vector3 } from "three";
import { element } from "./elements.ts";
import type { Placement, PlainOptions } from "./protocol.ts";
import { Quantity } from "./quantity.ts";
import type { Wanted } from "./view.ts";

const input = (id: string) => element(id, HTMLInputElement);
const select = (id: string) => element(id, HTMLSelectElement);

const [x, y, z] = [new Quantity("move-x"), new Quantity("move-y"), new Quantity("move-z")];
const turn = new Quantity("turn");
const [samples, samplesText] = [input("samples"), element("samples-text")];
const [method, tolerance, flatness] = [select("method"), select("tolerance"), select("flatness")];
const [symmetric, triangles] = [input("symmetric"), input("triangles")];
const [deviation, lines] = [input("deviation"), input("lines")];

/** The translation of A, in model units. */
export const moved = (): Vector3 => new Vector3(x.value, y.value, z.value);

/** Degrees that A is turned about its vertical axis. */
export const turned = (): number => turn.value;

export const wanted = (): Wanted => ({
  deviation: deviation.checked,
  lines: lines.checked,
  triangles: triangles.checked,
});

const fieldWanted = (): boolean => deviation.checked || lines.checked;

/** The options but for the transform. */
export function options(): PlainOptions {
  return {
    method: method.value as NonNullable<PlainOptions["method"]>,
    tolerance: Number(tolerance.value),
    samples: Number(samples.value),
    flatness: flatness.value as NonNullable<PlainOptions["flatness"]>,
    symmetric: symmetric.checked,
    field: fieldWanted(),
  };
}

/** Puts A in its place, which is in diagonals of the pair. */
export function place(placement: Placement, diagonal: number): void {
  [x, y, z].forEach((quantity, axis) => {
    quantity.unit = diagonal;
    quantity.value = (placement.move[axis] ?? 0) * diagonal;
  });
  turn.value = placement.turn;
}

/** Calls back on every change. */
export function onChange(callback: () => void): void {
  const changed = () => {
    tell();
    callback();
  };
  for (const quantity of [x, y, z, turn]) quantity.onChange = changed;
  for (const control of [
    ...[samples, method, tolerance, flatness],
    ...[symmetric, deviation, lines, triangles],
  ]) {
    control.addEventListener("input", changed);
  }
  tell();
}

/** Shows only what has a say in what is shown. */
function tell(): void {
  samplesText.textContent = `${samples.value}²`;
  const used = [method.value, fieldWanted() ? "field" : ""];
  for (const row of document.querySelectorAll<HTMLElement>("[data-for]")) {
    row.hidden = !row.dataset.for?.split(" ").some((use) => used.includes(use));
  }
}
