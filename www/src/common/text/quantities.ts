// Formatting of intervals of any quantity: areas, volumes, coordinates and masses, of either sign.

import type { Interval } from "nurbs-hausdorff";
import { texts } from "../../texts/index.ts";
import { heldNumber, magnitude, shownLength, upperText } from "./numbers.ts";

/** The relative rounding of a factor between units, which has three roundings, and of a product with it. */
const FACTOR_ROUNDING = 2 ** -51;
/** The relative rounding of a difference or a product, with a margin. */
const ROUNDING = 2 ** -52;

/** Digits of a number as far as its interval is narrow enough for them. */
const WANTED_DIGITS = 6;
/** Digits of float64, which ends of intervals are shown with at most. */
const SIGNIFICANT_DIGITS = 15;
/** Numbers of these sizes are written out, others with an exponent. */
const WRITTEN_OUT = { from: -4, below: 9 };

/** Returns an interval that holds all numbers of this one times `factor`, which is above 0 and off by at most `error`. */
export function times({ lower, upper }: Interval, factor: number, error = 0): Interval {
  if (factor === 1 && error === 0) return { lower, upper };
  return widened({ lower: lower * factor, upper: upper * factor }, error + ROUNDING);
}

/** Returns an interval that holds every number of the one less any of the other. */
export const minus = (one: Interval, other: Interval): Interval =>
  widened({ lower: one.lower - other.upper, upper: one.upper - other.lower }, ROUNDING);

function widened({ lower, upper }: Interval, relative: number): Interval {
  return { lower: lower - relative * Math.abs(lower), upper: upper + relative * Math.abs(upper) };
}

/**
 * Returns a quantity in the unit shown: `power` is 1 of lengths, 2 of areas, 3 of volumes, and `scale` the
 * shown model's units in one of the quantity's.
 */
export function shownQuantity(quantity: Interval, power: number, scale = 1): Interval {
  const length = shownLength(1) * scale;
  if (length === 1) return quantity;
  // Two factors between units, each to the power.
  return times(quantity, length ** power, 2 * (power + 1) * FACTOR_ROUNDING);
}

/** A number that the interval holds; of one about 0, how far the number is from 0 at most. */
export function quantityText({ lower, upper }: Interval, wanted = WANTED_DIGITS): string {
  if (lower === 0 && upper === 0) return "0";
  if (lower <= 0 && upper >= 0) {
    const end = upperText(Math.max(-lower, upper));
    return lower === 0 ? `≤ ${end}` : `±${end}`;
  }
  const isNegative = upper < 0;
  const [near, far] = isNegative ? [-upper, -lower] : [lower, upper];
  const text = positiveText(near, far, wanted);
  return isNegative ? `−${text}` : text;
}

function positiveText(near: number, far: number, wanted: number): string {
  const middle = near + (far - near) / 2;
  const size = magnitude(far);
  if (isWrittenOut(size)) return heldNumber(middle, [near, far], wanted - 1 - size);
  const known = far > near ? Math.floor(-Math.log10((far - near) / far)) : SIGNIFICANT_DIGITS;
  const first = Math.max(1, Math.min(wanted, known));
  for (let digits = first; digits <= SIGNIFICANT_DIGITS; digits++) {
    const text = middle.toExponential(digits - 1);
    if (near <= Number(text) && Number(text) <= far) return text;
  }
  return `${middle}`;
}

const isWrittenOut = (size: number): boolean =>
  WRITTEN_OUT.from <= size && size < WRITTEN_OUT.below;

/** The relative width up to which an interval is shown by a number: one of a wider one would say more than is known. */
const NARROW = 0.1;

/** Whether a number stands for the interval, which is at most this part of it wide, or for how near to 0 it is. */
export const isNarrow = ({ lower, upper }: Interval, part = NARROW): boolean =>
  (lower <= 0 && upper >= 0) || upper - lower <= part * Math.max(Math.abs(lower), Math.abs(upper));

/** As `quantityText` for tables: of many digits the first ones, with dots that say that there are more. */
export const listedQuantity = (interval: Interval): string =>
  cut(quantityText(interval), WANTED_DIGITS);

/** The first digits of a number's text, and all of its whole part. */
function cut(text: string, digits: number): string {
  const [mantissa = "", exponent = ""] = text.split(/(?=e)/);
  const [point, first] = [mantissa.indexOf("."), mantissa.search(/[1-9]/)];
  if (point < 0) return text;
  const wanted = first + digits + (first < point ? 1 : 0);
  // The point is not the last of what is shown.
  const end = wanted <= point + 1 ? point : wanted;
  if (mantissa.length <= end + 1) return text;
  return `${mantissa.slice(0, end)}…${exponent}`;
}

/** Digits of a part in percent that are looked for, and that are shown at most. */
const PERCENT_DIGITS = { wanted: 3, most: 5 };

/** A change in percent of what it is of, with its sign; nothing where the sign is not certain. */
export function percentText(change: Interval, of: Interval): string {
  const isCertain = change.lower > 0 || change.upper < 0;
  if (!isCertain || of.lower <= 0) return "";
  const isMore = change.lower > 0;
  const part = times(
    widened(
      {
        lower: change.lower / (isMore ? of.upper : of.lower),
        upper: change.upper / (isMore ? of.lower : of.upper),
      },
      ROUNDING,
    ),
    PERCENT,
  );
  if (!isNarrow(part)) return "";
  const text = cut(quantityText(part, PERCENT_DIGITS.wanted), PERCENT_DIGITS.most);
  return `${isMore ? "+" : ""}${text} %`;
}

const PERCENT = 100;

/** An interval with its ends rounded outwards, with two digits more than tell them apart. */
export function rangeText({ lower, upper }: Interval): string {
  if (lower === 0 && upper === 0) return "[0, 0]";
  const size = magnitude(Math.max(Math.abs(lower), Math.abs(upper)));
  const available = SIGNIFICANT_DIGITS - 1 - size;
  const wanted = upper > lower ? 2 - magnitude(upper - lower) : available;
  const digits = Math.min(wanted, available);
  return `[${outwards(lower, -1, size, digits)}, ${outwards(upper, 1, size, digits)}]`;
}

/** An end with this many digits behind the point, or as many with an exponent, rounded outwards. */
function outwards(end: number, sign: -1 | 1, size: number, digits: number): string {
  const step = 10 ** -digits;
  const text = (value: number) =>
    isWrittenOut(size) || value === 0
      ? value.toFixed(Math.max(0, digits))
      : value.toExponential(Math.max(0, digits + magnitude(Math.abs(value))));
  const rounded = text(end);
  const safe = sign * (Number(rounded) - end) >= 0 ? rounded : text(Number(rounded) + sign * step);
  return safe.replace(/^-/, "−");
}

/** A number that the interval holds; a wide interval itself. */
export const narrowText = (interval: Interval, part = NARROW): string =>
  isNarrow(interval, part) ? listedQuantity(interval) : rangeText(interval);

/** A number that the interval holds, with the interval; a wide interval alone. */
export const wholeText = (interval: Interval): string =>
  isNarrow(interval)
    ? texts.common.numberIn(listedQuantity(interval), rangeText(interval))
    : rangeText(interval);
