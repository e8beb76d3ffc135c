// A number input: a slider together with a field for the exact value.
import { element } from "../common/elements.ts";

/** Significant digits of a value set with the slider. */
const DIGITS = 5;
/**
 * The largest value, in slider's units: beyond it float64 has fewer than four digits of the models
 * left, and the squares in the view would overflow float32.
 */
const LARGEST = 1e12;

export class NumberInput {
  onChange: () => void = () => {};
  /** The value that 1 on the slider stands for. */
  unit = 1;
  readonly #slider: HTMLInputElement;
  readonly #exact: HTMLInputElement;

  /** Connects the slider with this identifier to the field named by it and `-exact`. */
  constructor(id: string) {
    this.#slider = element(id, HTMLInputElement);
    this.#exact = element(`${id}-exact`, HTMLInputElement);
    this.#slider.addEventListener("input", () => {
      this.#exact.value = short(this.#slider.valueAsNumber * this.unit);
      this.onChange();
    });
    this.#exact.addEventListener("input", () => {
      // A half-typed number, such as a lone minus sign, parses as NaN.
      if (!Number.isFinite(this.#exact.valueAsNumber)) return;
      const largest = LARGEST * this.unit;
      if (Math.abs(this.value) > largest) {
        this.#exact.value = `${Math.sign(this.value) * largest}`;
      }
      this.#slider.value = `${this.value / this.unit}`;
      this.onChange();
    });
  }

  /** The value of the field, which may lie outside the slider's range; 0 while it is not a number. */
  get value(): number {
    const value = this.#exact.valueAsNumber;
    return Number.isFinite(value) ? value : 0;
  }

  set value(value: number) {
    this.#show(value, short(value));
  }

  /** Sets a computed value, rounded to this resolution: no less is 0. */
  setComputed(value: number, resolution: number): void {
    this.#show(value, rounded(value, resolution));
  }

  #show(value: number, text: string): void {
    this.#exact.value = text;
    this.#slider.value = `${value / this.unit}`;
  }
}

/** The largest number of decimals that numbers can be written with. */
const MAX_DECIMALS = 100;

/** The value with as many decimals as the resolution gives sense, and no exponent. */
function rounded(value: number, resolution: number): string {
  const decimals = Math.min(Math.max(Math.ceil(-Math.log10(resolution)), 0), MAX_DECIMALS);
  const text = value.toFixed(decimals);
  return text.includes(".") ? text.replace(/\.?0+$/, "").replace(/^-0$/, "0") : text;
}

const short = (value: number): string => `${Number(value.toPrecision(DIGITS))}`;
