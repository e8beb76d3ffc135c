// The numbers of all methods at one position.
import { element } from "../elements.ts";
import { duration } from "../numbers.ts";
import { axisNumber } from "./axis-number.ts";
import type { Curve, Outcome } from "./outcome.ts";

const section = element("reading");
const slider = element("at", HTMLInputElement);
const position = element("at-text");
const rows = element("reading-rows");

/** Significant digits of a distance. */
const DIGITS = 9;

export class Reading {
  #positions: readonly number[] = [];
  #curves: readonly Curve[] = [];
  /** Whether the user chose the position. */
  #held = false;

  constructor() {
    slider.addEventListener("input", () => this.at(slider.valueAsNumber));
  }

  show(positions: readonly number[], curves: readonly Curve[]): void {
    this.#positions = positions;
    this.#curves = curves;
    slider.max = `${positions.length - 1}`;
    section.hidden = false;
    this.#held = false;
    this.#read(0);
  }

  /** Reads at the position of this index, and stays there. */
  at(index: number): void {
    this.#held = true;
    this.#read(index);
  }

  /** Reads where the newest outcomes are, or again where the user wants to. */
  follow(): void {
    const newest = (this.#curves[0]?.outcomes.length ?? 1) - 1;
    this.#read(this.#held ? slider.valueAsNumber : newest);
  }

  #read(index: number): void {
    slider.value = `${index}`;
    position.textContent = axisNumber(this.#positions[index] ?? null);
    rows.replaceChildren(
      ...this.#curves.map(({ method, outcomes }) => row(method.name, outcomes[index])),
    );
  }
}

function row(name: string, outcome: Outcome | undefined): HTMLTableRowElement {
  const line = document.createElement("tr");
  line.append(cell("th", name));
  if (outcome?.failure !== undefined) {
    const why = cell("td", outcome.failure.code);
    why.colSpan = 4;
    line.append(why);
    return line;
  }
  const result = outcome?.result;
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
