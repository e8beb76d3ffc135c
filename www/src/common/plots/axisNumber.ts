// Number formatting for axes.

/** Sizes in [MIN_PLAIN, MAX_PLAIN) are written without an exponent. */
const MIN_PLAIN = 1e-3;
const MAX_PLAIN = 1e5;
/** Smaller values are 0: the tick at 0 carries the rounding error of the steps to it. */
const ZERO = 1e-12;

/** Returns the text of a number at an axis, empty for `null`, which is a tick without a number. */
export function axisNumber(value: number | null): string {
  if (value === null) return "";
  const size = Math.abs(value);
  if (size < ZERO) return "0";
  if (size >= MIN_PLAIN && size < MAX_PLAIN) return `${Number(value.toFixed(4))}`;
  return `${Number(value.toPrecision(2)).toExponential()}`;
}
