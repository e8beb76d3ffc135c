// A number input: a slider together with a field for the exact value, which the state holds.
import { effect, type ReadonlySignal, signal } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { type Field, field } from "../state/store.ts";

/** Significant digits of a value set with the slider. */
const DIGITS = 5;
/**
 * The largest value, in slider's units: beyond it float64 has fewer than four digits of the models
 * left, and the squares in the view would overflow float32.
 */
const LARGEST = 1e12;

export class NumberInput {
  readonly #field: Field;
  readonly #value = signal(0);
  readonly #unit = signal(1);

  /** Connects the slider with this identifier to the field of this name. */
  constructor(id: string, name: string) {
    const slider = element(id, HTMLInputElement);
    this.#field = field(name);
    slider.addEventListener("input", () => this.set(slider.valueAsNumber * this.#unit.peek()));
    effect(() => {
      const text = this.#field.value;
      const typed = Number(text);
      // A number that is typed in part, such as a lone minus sign, is none.
      if (text === "" || !Number.isFinite(typed)) return;
      const largest = LARGEST * this.#unit.value;
      if (Math.abs(typed) > largest) this.#field.set(`${Math.sign(typed) * largest}`);
      else this.#value.value = typed;
    });
    effect(() => {
      slider.value = `${this.#value.value / this.#unit.value}`;
    });
  }

  /** The number, which may lie outside the slider's range; that before while none is typed. */
  get value(): ReadonlySignal<number> {
    return this.#value;
  }

  /** The value that 1 on the slider stands for. */
  set unit(unit: number) {
    this.#unit.value = unit;
  }

  get unit(): number {
    return this.#unit.peek();
  }

  /** Sets a value, to a slider's digits. */
  set(value: number): void {
    this.#field.set(short(value));
  }

  /** Sets a computed value, rounded to this resolution: no less is 0. */
  setComputed(value: number, resolution: number): void {
    this.#field.set(rounded(value, resolution));
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
