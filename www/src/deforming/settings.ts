// The settings of the panel.
import { element } from "../common/elements.ts";
import type { Size } from "./sheet.ts";

/** What is deformed and measured. */
export interface Settings {
  size: Size;
  /** The name of a shape. */
  part: string;
  method: "certified" | "hierarchy";
  relativeTolerance: number;
}

const select = (id: string) => element(id, HTMLSelectElement);
const [size, part, method, tolerance] = ["size", "part", "method", "tolerance"].map(select) as [
  HTMLSelectElement,
  HTMLSelectElement,
  HTMLSelectElement,
  HTMLSelectElement,
];

export function settings(): Settings {
  const [rows = 0, columns = 0] = size.value.split(" ").map(Number);
  return {
    size: [rows, columns],
    part: part.value,
    method: method.value as Settings["method"],
    relativeTolerance: Number(tolerance.value),
  };
}

export function onSettings(onChange: () => void): void {
  for (const control of [size, part, method, tolerance]) {
    control.addEventListener("input", onChange);
  }
}
