import type { Transform } from "../../measure/options.js";
import type { Argument } from "./table.js";

/** The value of an argument, by its type. */
export type Value = boolean | number | string | Transform;

/** Numbers as Rust parses them. */
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const NOT_FINITE: Readonly<Record<string, number>> = {
  inf: Infinity,
  infinity: Infinity,
  nan: NaN,
};

/**
 * The value of a text.
 *
 * @throws {Error} with what is wrong with it.
 */
export function parseValue(argument: Argument, text: string): Value {
  switch (argument.type) {
    case "number":
      return number(text);
    case "integer":
      if (!/^\+?\d+$/.test(text)) throw new Error("invalid digit found in string");
      return Number(text);
    case "choice":
      if (!argument.choices?.includes(text)) {
        throw new Error(`expected one of ${argument.choices?.join(", ")}`);
      }
      return text;
    case "translation":
      return { translation: numbers(text, 3) as [number, number, number] };
    case "rotation":
      return { rotation: quaternion(numbers(text, 4)) };
    default:
      return text;
  }
}

function number(text: string): number {
  const special = NOT_FINITE[text.replace(/^[+-]/, "").toLowerCase()];
  if (special !== undefined) return text.startsWith("-") ? -special : special;
  if (!NUMBER.test(text)) throw new Error("invalid float literal");
  return Number(text);
}

/** Finite numbers separated by commas. */
function numbers(text: string, expected: number): number[] {
  const found = text.split(",").map((part) => {
    const trimmed = part.trim();
    const value = NUMBER.test(trimmed) ? Number(trimmed) : NaN;
    if (!Number.isFinite(value)) throw new Error(`found "${part}", expected a finite number`);
    return value;
  });
  if (found.length !== expected) {
    throw new Error(`found ${found.length} numbers, expected ${expected}`);
  }
  return found;
}

/** The unit quaternion of the rotation about an axis through the origin by an angle in degrees. */
function quaternion([x = 0, y = 0, z = 0, degrees = 0]: number[]): [
  number,
  number,
  number,
  number,
] {
  const largest = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
  if (largest === 0) throw new Error("the axis has length 0");
  // Scaled first, so that no square overflows or vanishes.
  const axis = [x / largest, y / largest, z / largest];
  const length = Math.hypot(...axis);
  const half = (degrees * (Math.PI / 180)) / 2;
  const [a = 0, b = 0, c = 0] = axis.map((value) => (value / length) * Math.sin(half));
  return [a, b, c, Math.cos(half)];
}
