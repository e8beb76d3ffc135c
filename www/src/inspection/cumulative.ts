// Areas of parts of distributions. Estimates, as the maps are.
import type { Allowed } from "../scene/colors/scale.ts";
import type { Cumulative, Distribution } from "../worker/map/distribution.ts";

/** Returns the area whose value is less than this. O(log n). */
export function areaBelow({ values, areas }: Cumulative, value: number): number {
  let [from, to] = [0, values.length];
  while (from < to) {
    const middle = (from + to) >> 1;
    if ((values[middle] ?? 0) < value) from = middle + 1;
    else to = middle;
  }
  return from === 0 ? 0 : (areas[from - 1] ?? 0);
}

export const totalArea = ({ areas }: Cumulative): number => areas.at(-1) ?? 0;

/** Returns the area whose value exceeds this. */
function areaAbove(all: Cumulative, value: number): number {
  // The next number above, as a value at the limit is within it.
  const next = value + Math.max(Number.MIN_VALUE, Math.abs(value) * Number.EPSILON);
  return totalArea(all) - areaBelow(all, next);
}

/** Returns the area whose deviation is not allowed. */
export function areaBeyond({ absolute, signed }: Distribution, { above, below }: Allowed): number {
  if (above === below) return areaAbove(absolute, above);
  return areaAbove(signed, above) + areaBelow(signed, -below);
}

/** Returns the fractions of the areas in `count` bins between two values; those beyond are in the end bins. */
export function histogramOf(
  all: readonly Cumulative[],
  low: number,
  high: number,
  count: number,
): number[] {
  const total = all.reduce((sum, one) => sum + totalArea(one), 0) || 1;
  const below = Array.from({ length: count + 1 }, (_, edge) =>
    all.reduce((sum, one) => {
      if (edge === 0) return sum;
      const value = low + (edge / count) * (high - low);
      return sum + (edge === count ? totalArea(one) : areaBelow(one, value));
    }, 0),
  );
  return below.slice(1).map((area, bin) => (area - (below[bin] ?? 0)) / total);
}
