// The histogram of the deviation beside the upright scale, in its colours.

import type { ColorScale } from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { Distribution } from "../worker/map/distribution.ts";
import { histogramOf } from "./cumulative.ts";

export const BINS = 48;
/** The width of the drawing, which is stretched. */
const WIDTH = 60;

const SVG = "http://www.w3.org/2000/svg";

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
): SVGSVGElement {
  const longest = Math.max(...bins) || 1;
  const colors = scale.stops(BINS);
  const drawing = document.createElementNS(SVG, "svg");
  drawing.setAttribute("viewBox", `0 0 ${WIDTH} ${BINS}`);
  drawing.setAttribute("preserveAspectRatio", "none");
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", texts.places.histogramOfTheDeviationOver);
  for (const [bin, fraction] of bins.entries()) {
    const y = BINS - 1 - bin;
    // Little area is seen too.
    const width = fraction > 0 ? Math.max(1, (WIDTH * fraction) / longest) : 0;
    const bar = rectangle({ x: 0, y, width, height: 1.02 }, colors[bin]?.getStyle() ?? "none");
    const target = rectangle({ x: 0, y, width: WIDTH, height: 1 }, "transparent");
    target.setAttribute("class", "target");
    target.addEventListener("click", () => onBin(bin));
    drawing.append(bar, target);
  }
  return drawing;
}

function rectangle(sizes: Record<string, number>, fill: string): SVGRectElement {
  const node = document.createElementNS(SVG, "rect");
  for (const [name, size] of Object.entries(sizes)) node.setAttribute(name, `${size}`);
  node.setAttribute("fill", fill);
  return node;
}
