// A number that is dragged with a slider or typed exactly.
import { element } from "./elements.ts";

/** Significant digits of what is dragged. */
const DIGITS = 5;

export class Quantity {
  onChange: () => void = () => {};
  /** What 1 on the slider is. */
  unit = 1;
  readonly #slider: HTMLInputElement;
  readonly #exact: HTMLInputElement;

  /** For the slider of this identifier, and the field with `-exact` appended. */
  constructor(id: string) {
    this.#slider = element(id, HTMLInputElement);
    this.#exact = element(`${id}-exact`, HTMLInputElement);
    this.#slider.addEventListener("input", () => {
      this.#exact.value = short(this.#slider.valueAsNumber * this.unit);
      this.onChange();
    });
    this.#exact.addEventListener("input", () => {
      // Half-typed numbers, such as a minus sign, are none.
      if (!Number.isFinite(this.#exact.valueAsNumber)) return;
      this.#slider.value = `${this.value / this.unit}`;
      this.onChange();
    });
  }

  /** What the field says; the slider may be at its end. */
  get value(): number {
    const value = this.#exact.valueAsNumber;
    return Number.isFinite(value) ? value : 0;
  }

  set value(value: number) {
    this.#exact.value = short(value);
    this.#slider.value = `${value / this.unit}`;
  }
}

const short = (value: number): string => `${Number(value.toPrecision(DIGITS))}`;
