// What the user chose in the panel.
import type { Vector3 } from "nurbs-hausdorff";
import { element } from "./elements.ts";
import type { PlainOptions } from "./protocol.ts";

const range = (id: string) => element(id, HTMLInputElement);
const select = (id: string) => element(id, HTMLSelectElement);
const moves = ["move-x", "move-y", "move-z"].map(range);
const [turn, samples] = [range("turn"), range("samples")];
const [method, tolerance, flatness] = [select("method"), select("tolerance"), select("flatness")];
const [symmetric, lines, edges] = [range("symmetric"), range("lines"), range("edges")];

/** Parts of the diagonal that A is moved along x, y, z. */
export const moved = (): Vector3 => [
  Number(moves[0]?.value),
  Number(moves[1]?.value),
  Number(moves[2]?.value),
];

export const turned = (): number => Number(turn.value);

export const linesWanted = (): boolean => lines.checked;

export const edgesWanted = (): boolean => edges.checked;

/** The options but for the transform. */
export function options(): PlainOptions {
  return {
    method: method.value as "certified" | "iteration",
    tolerance: Number(tolerance.value),
    samples: Number(samples.value),
    flatness: flatness.value as "none" | "loose" | "tight" | "curvature",
    symmetric: symmetric.checked,
    field: lines.checked,
  };
}

/** Sets where A stands. */
export function place(move: Vector3, degrees: number): void {
  moves.forEach((input, axis) => {
    input.value = `${move[axis] ?? 0}`;
  });
  turn.value = `${degrees}`;
  tell();
}

/** Calls back on every change, with what kind it is. */
export function onChange(callback: () => void): void {
  for (const input of [
    ...moves,
    turn,
    samples,
    method,
    tolerance,
    flatness,
    symmetric,
    lines,
    edges,
  ]) {
    input.addEventListener("input", () => {
      tell();
      callback();
    });
  }
  tell();
}

/** Shows the sliders' values, and only the options of the chosen method. */
function tell(): void {
  for (const input of [...moves, turn, samples]) {
    const output = input.parentElement?.querySelector("output");
    if (output) output.textContent = text(input);
  }
  for (const label of document.querySelectorAll<HTMLElement>("[data-for]")) {
    label.hidden = label.dataset.for !== method.value;
  }
}

function text(input: HTMLInputElement): string {
  if (input === samples) return `${input.value}²`;
  if (input === turn) return `${input.value}°`;
  return `${(Number(input.value) * 100).toFixed(1)} %`;
}
