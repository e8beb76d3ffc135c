// Numbers as text.

/** Digits that a distance is told with beyond the width of its interval. */
const MOST_DIGITS = 9;

/** A distance with digits in proportion to the models' size. */
export function distanceText(distance: number, diagonal: number): string {
  const digits = 5 - Math.floor(Math.log10(diagonal > 0 ? diagonal : 1));
  return distance.toFixed(Math.min(MOST_DIGITS, Math.max(0, digits)));
}

/** Nine significant digits. */
export const precise = (value: number): string => value.toPrecision(9);

/** Two significant digits, as for a width. */
export const rough = (value: number): string => value.toExponential(1);

/** Milliseconds of seconds. */
export const milliseconds = (seconds: number): string => `${(seconds * 1e3).toFixed(1)} ms`;
