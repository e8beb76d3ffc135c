// All panels, with common colours and a common cursor.
import { element } from "../../common/elements.ts";
import { pageColor } from "../../common/pageColor.ts";
import type { Curve } from "../sweep/sweepPoint.ts";
import { panels } from "./panels.ts";
import { type Colors, Plot } from "./plot.ts";

/** Whether the time axis is logarithmic. */
const logarithmicTime = element("logarithmic-time", HTMLInputElement);

export class Plots {
  readonly #methodColor: (method: string) => string;
  readonly #onCursor: (index: number) => void;
  #plots: Plot[] = [];
  #positions: readonly number[] = [];
  #curves: readonly Curve[] = [];

  /** Calls `onCursor` with the index of the position under the pointer. */
  constructor(methodColor: (method: string) => string, onCursor: (index: number) => void) {
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
    const colors = pageColors(this.#methodColor);
    this.#plots = panels.map((panel) => {
      const logarithmic = panel.id === "time" ? logarithmicTime.checked : panel.logarithmic;
      return new Plot(
        element(`plot-${panel.id}`),
        { ...panel, logarithmic },
        this.#positions,
        this.#curves,
        colors,
        this.#onCursor,
      );
    });
  }
}

function pageColors(method: Colors["method"]): Colors {
  return { ink: pageColor("ink"), grid: pageColor("line"), method };
}
