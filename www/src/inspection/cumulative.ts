// Areas of parts of a distribution. Estimates, as the samples are.
import type { Cumulative, Distribution } from "../worker/field/distribution.ts";

/** Returns the area of the samples whose value is less than this. O(log n). */
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

/** Returns the area whose distance exceeds the limit. */
export function areaBeyond({ absolute }: Distribution, limit: number): number {
  // The next number above the limit, as samples at the limit are within it.
  const above = limit + Math.max(Number.MIN_VALUE, limit * Number.EPSILON);
  return totalArea(absolute) - areaBelow(absolute, above);
}

/** Returns the fractions of the area in `count` bins between two values; those beyond are in the end bins. */
export function histogramOf(all: Cumulative, low: number, high: number, count: number): number[] {
  const total = totalArea(all) || 1;
  const below = Array.from({ length: count + 1 }, (_, edge) => {
    if (edge === 0) return 0;
    return edge === count ? total : areaBelow(all, low + (edge / count) * (high - low));
  });
  return below.slice(1).map((area, bin) => (area - (below[bin] ?? 0)) / total);
}
