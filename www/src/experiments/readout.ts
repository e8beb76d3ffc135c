// The results of all methods at one position.
import { element } from "../common/elements.ts";
import { axisNumber } from "../common/plots/axisNumber.ts";
import { duration } from "../common/text/numbers.ts";
import type { Curve, SweepPoint } from "./sweep/sweepPoint.ts";

const section = element("readout");
const slider = element("at", HTMLInputElement);
const position = element("at-text");
const rows = element("readout-rows");

/** Significant digits of a distance. */
const DIGITS = 9;

export class Readout {
  #positions: readonly number[] = [];
  #curves: readonly Curve[] = [];
  /** Whether the user chose the position. */
  #pinned = false;

  constructor() {
    slider.addEventListener("input", () => this.showPosition(slider.valueAsNumber));
  }

  /** Shows new curves, which may still grow. */
  show(positions: readonly number[], curves: readonly Curve[]): void {
    this.#positions = positions;
    this.#curves = curves;
    slider.max = `${positions.length - 1}`;
    section.hidden = false;
    this.#pinned = false;
    this.#draw(0);
  }

  /** Shows the position with this index from now on. */
  showPosition(index: number): void {
    this.#pinned = true;
    this.#draw(index);
  }

  /** Shows the newest results, or those at the position that the user chose. */
  update(): void {
    const newest = (this.#curves[0]?.points.length ?? 1) - 1;
    this.#draw(this.#pinned ? slider.valueAsNumber : newest);
  }

  #draw(index: number): void {
    slider.value = `${index}`;
    position.textContent = axisNumber(this.#positions[index] ?? null);
    rows.replaceChildren(
      ...this.#curves.map(({ method, points }) => row(method.name, points[index])),
    );
  }
}

function row(name: string, point: SweepPoint | undefined): HTMLTableRowElement {
  const line = document.createElement("tr");
  line.append(cell("th", name));
  if (point?.failure !== undefined) {
    const code = cell("td", point.failure.code);
    code.colSpan = 4;
    line.append(code);
    return line;
  }
  const result = point?.result;
  const numbers =
    result === undefined ? [] : [result.computed, result.lower, result.upper].map(short);
  const time = result === undefined ? [] : [duration(result.seconds.solve)];
  const texts = [...time, ...numbers];
  line.append(...Array.from({ length: 4 }, (_, column) => cell("td", texts[column] ?? "…")));
  return line;
}

const short = (value: number): string => `${Number(value.toPrecision(DIGITS))}`;

function cell(kind: "th" | "td", text: string): HTMLTableCellElement {
  const made = document.createElement(kind);
  made.textContent = text;
  return made;
}
