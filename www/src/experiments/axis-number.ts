// Numbers beside an axis.

/** Where numbers are written with the digits they need. */
const SMALLEST = 1e-3;
const LARGEST = 1e5;
/** A tick at 0 comes with the rounding of the steps to it. */
const ZERO = 1e-12;

/** Others than those of usual size as powers of ten; `null`, a tick without a number, as nothing. */
export function axisNumber(value: number | null): string {
  if (value === null) return "";
  const size = Math.abs(value);
  if (size < ZERO) return "0";
  if (size >= SMALLEST && size < LARGEST) return `${Number(value.toFixed(4))}`;
  return `${Number(value.toPrecision(2)).toExponential()}`;
}
