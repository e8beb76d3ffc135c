/** Sizes from which, and below which, Rust prints numbers with an exponent. */
const LARGE = 1e16;
const SMALL = 1e-5;

/** The number in the fewest digits that denote it, as Rust's `{:?}` prints it. */
export function full(number: number): string {
  if (Number.isNaN(number)) return "NaN";
  if (!Number.isFinite(number)) return number < 0 ? "-inf" : "inf";
  if (number === 0) return Object.is(number, -0) ? "-0.0" : "0.0";
  const size = Math.abs(number);
  if (size < SMALL || size >= LARGE) return number.toExponential().replace("e+", "e");
  // From 1e-7 on JavaScript prints no exponent, and above only from 1e21.
  const text = size < 1e-6 ? number.toFixed(20) : String(number);
  return text.includes(".") ? text : `${text}.0`;
}

/** The number to six digits, without zeros at the end. */
export function short(number: number): string {
  return Number.isFinite(number) ? full(Number(number.toExponential(5))) : full(number);
}

/** The number in exponential form with this many digits after the point. */
export function exponential(number: number, digits: number): string {
  return number.toExponential(digits).replace("e+", "e");
}
