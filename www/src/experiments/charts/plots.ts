// All panels, with common colours and a common cursor.
import { element } from "../../common/elements.ts";
import type { Curve } from "../sweep/sweepPoint.ts";
import { panels } from "./panels.ts";
import { type ColorOf, Plot } from "./plot.ts";

/** Whether the time axis is logarithmic. */
const logarithmicTime = element("logarithmic-time", HTMLInputElement);

export class Plots {
  readonly #methodColor: ColorOf;
  readonly #onCursor: (index: number) => void;
  #plots: Plot[] = [];
  #positions: readonly number[] = [];
  #curves: readonly Curve[] = [];

  /** Calls `onCursor` with the index of the position under the pointer. */
  constructor(methodColor: ColorOf, onCursor: (index: number) => void) {
    this.#methodColor = methodColor;
    this.#onCursor = onCursor;
    logarithmicTime.addEventListener("change", () => this.#build());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#build());
  }

  /** Draws new curves, which may still grow. */
  show(positions: readonly number[], curves: readonly Curve[]): void {
    this.#positions = positions;
    this.#curves = curves;
    this.#build();
  }

  /** Draws the results that have arrived. */
  update(): void {
    for (const plot of this.#plots) plot.update();
  }

  #build(): void {
    for (const plot of this.#plots) plot.dispose();
    this.#plots = panels.map((panel) => {
      const logarithmic = panel.id === "time" ? logarithmicTime.checked : panel.logarithmic;
      return new Plot(
        element(`plot-${panel.id}`),
        { ...panel, logarithmic },
        this.#positions,
        this.#curves,
        this.#methodColor,
        this.#onCursor,
      );
    });
  }
}
