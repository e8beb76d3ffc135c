// Numbers as text.

/** Significant digits of float64 that can be trusted. */
const SIGNIFICANT_DIGITS = 15;
/** Digits after the point that `toFixed` takes, at most. */
const MOST_DIGITS = 100;
/** Digits of a distance beyond the models' order of magnitude. */
const RELATIVE_DIGITS = 5;

/** A distance with digits in proportion to the models' size. */
export function distanceText(distance: number, diagonal: number): string {
  return distance.toFixed(digitsAfterPoint(RELATIVE_DIGITS - magnitude(diagonal)));
}

/** The same with its sign. */
export function signedText(distance: number, diagonal: number): string {
  const text = distanceText(Math.abs(distance), diagonal);
  return distance < 0 ? `−${text}` : `+${text}`;
}

/**
 * The ends of an interval with digits enough to tell them apart, as far as the
 * models' size has them, rounded outwards so that what is read contains what
 * was certified.
 */
export function intervalText(lower: number, upper: number, diagonal: number): string {
  const width = upper - lower;
  const trusted = SIGNIFICANT_DIGITS - 1 - magnitude(Math.max(upper, diagonal));
  const shown = digitsAfterPoint(width > 0 ? Math.min(2 - magnitude(width), trusted) : trusted);
  const step = 10 ** -shown;
  const outwards = (end: number, sign: -1 | 1) => {
    const rounded = Number(end.toFixed(shown));
    return (sign * (rounded - end) < 0 ? rounded + sign * step : rounded).toFixed(shown);
  };
  return `[${outwards(lower, -1)}, ${outwards(upper, 1)}]`;
}

/** The exponent of ten of a size; 0 where there is none. */
const magnitude = (size: number): number => (size > 0 ? Math.floor(Math.log10(size)) : 0);

const digitsAfterPoint = (wanted: number): number => Math.min(MOST_DIGITS, Math.max(0, wanted));

/** Two significant digits, as for a width: 2.8·10⁻⁶. */
export function rough(value: number): string {
  if (value === 0) return "0";
  const [digits = "", exponent = ""] = value.toExponential(1).split("e");
  if (Math.abs(Number(exponent)) < 3) return `${Number(value.toPrecision(2))}`;
  const raised = [...`${Number(exponent)}`].map((digit) => RAISED[digit] ?? digit).join("");
  return `${digits}·10${raised}`;
}

const RAISED: Record<string, string> = {
  "-": "⁻",
  ...Object.fromEntries([..."⁰¹²³⁴⁵⁶⁷⁸⁹"].map((raised, digit) => [digit, raised])),
};

/** Seconds in their customary unit. */
export function duration(seconds: number): string {
  return seconds < 1 ? `${(seconds * 1e3).toFixed(1)} ms` : `${seconds.toFixed(2)} s`;
}

/** A whole number in groups of three digits. */
export const grouped = (count: number): string => count.toLocaleString("en");
