// All panels together, with one look and one cursor.
import { element } from "../elements.ts";
import { colorOf } from "./method-list.ts";
import type { Curve } from "./outcome.ts";
import { panels } from "./panels.ts";
import { type Look, Plot } from "./plot.ts";

/** Whether the time axis is logarithmic. */
const logarithmicTime = element("logarithmic-time", HTMLInputElement);

export class Plots {
  readonly #onCursor: (index: number) => void;
  #plots: Plot[] = [];
  #positions: readonly number[] = [];
  #curves: readonly Curve[] = [];

  /** `onCursor` hears the index of the position that is pointed at. */
  constructor(onCursor: (index: number) => void) {
    this.#onCursor = onCursor;
    logarithmicTime.addEventListener("change", () => this.#build());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#build());
  }

  /** Draws other curves; they are followed as they grow. */
  show(positions: readonly number[], curves: readonly Curve[]): void {
    this.#positions = positions;
    this.#curves = curves;
    this.#build();
  }

  /** Draws what the curves have now. */
  update(): void {
    for (const plot of this.#plots) plot.update();
  }

  #build(): void {
    for (const plot of this.#plots) plot.dispose();
    const look = lookOfPage();
    this.#plots = panels.map((panel) => {
      const logarithmic = panel.id === "time" ? logarithmicTime.checked : panel.logarithmic;
      return new Plot(
        element(`plot-${panel.id}`),
        { ...panel, logarithmic },
        this.#positions,
        this.#curves,
        look,
        this.#onCursor,
      );
    });
  }
}

/** The style sheet's colours as they are in the scheme of the moment, which a canvas is to be told. */
function lookOfPage(): Look {
  const colored = (name: string) => {
    const probe = document.createElement("i");
    probe.style.color = `var(--${name})`;
    document.body.append(probe);
    const { color } = getComputedStyle(probe);
    probe.remove();
    return color;
  };
  return { ink: colored("ink"), grid: colored("line"), of: colorOf };
}
