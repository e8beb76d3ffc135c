// Numbers as text.

/** Digits after the point, at most. */
const MOST_DIGITS = 12;
/** Digits of a distance beyond the models' order of magnitude. */
const RELATIVE_DIGITS = 5;

/** A distance with digits in proportion to the models' size. */
export function distanceText(distance: number, diagonal: number): string {
  const magnitude = Math.floor(Math.log10(diagonal > 0 ? diagonal : 1));
  return distance.toFixed(Math.min(MOST_DIGITS, Math.max(0, RELATIVE_DIGITS - magnitude)));
}

/**
 * The ends of an interval with digits enough to tell them apart, rounded
 * outwards so that what is read contains what was certified.
 */
export function intervalText(lower: number, upper: number): string {
  const width = upper - lower;
  const digits = width > 0 ? 2 - Math.floor(Math.log10(width)) : MOST_DIGITS;
  const shown = Math.min(MOST_DIGITS, Math.max(0, digits));
  const step = 10 ** -shown;
  const outwards = (end: number, sign: -1 | 1) => {
    const rounded = Number(end.toFixed(shown));
    return (sign * (rounded - end) < 0 ? rounded + sign * step : rounded).toFixed(shown);
  };
  return `[${outwards(lower, -1)}, ${outwards(upper, 1)}]`;
}

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
