// The histogram of the deviation beside the upright scale, in its colours.

import { draw } from "../common/drawing.ts";
import type { ColorScale } from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { Distribution } from "../worker/map/distribution.ts";
import { histogramOf } from "./cumulative.ts";

export const BINS = 48;
/** The width of the drawing, which is stretched. */
const WIDTH = 60;

/** The fractions of the areas in bins over the scale's range. */
export function binsOf(
  distributions: readonly Distribution[],
  scale: ColorScale,
  isAbsolute: boolean,
): number[] {
  const all = distributions.map(({ absolute, signed }) => (isAbsolute ? absolute : signed));
  return histogramOf(all, scale.low, scale.high, BINS);
}

/** Returns the bins as a drawing, the lowest at the foot; calls back with a bin that is pressed. */
export function histogram(
  bins: readonly number[],
  scale: ColorScale,
  onBin: (bin: number) => void,
): SVGElement {
  const longest = Math.max(...bins) || 1;
  const colors = scale.stops(BINS);
  const drawing = draw("svg", {
    ...{ viewBox: `0 0 ${WIDTH} ${BINS}`, preserveAspectRatio: "none", role: "img" },
    "aria-label": texts.places.histogramOfTheDeviationOver,
  });
  for (const [bin, fraction] of bins.entries()) {
    const y = BINS - 1 - bin;
    // Little area is seen too.
    const width = fraction > 0 ? Math.max(1, (WIDTH * fraction) / longest) : 0;
    const fill = colors[bin]?.getStyle() ?? "none";
    const bar = draw("rect", { x: 0, y, width, height: 1.02, fill });
    const whole = { x: 0, y, width: WIDTH, height: 1, fill: "transparent" };
    const target = draw("rect", { ...whole, class: "target" });
    target.addEventListener("click", () => onBin(bin));
    drawing.append(bar, target);
  }
  return drawing;
}
