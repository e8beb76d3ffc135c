// The histogram of the deviation, in the colours of the scale.
import type { ColorScale } from "../scene/colors/scale.ts";
import type { Distribution } from "../worker/field/distribution.ts";
import { histogramOf } from "./cumulative.ts";

const BINS = 48;
/** The size of the drawing, which is stretched to the panel's width. */
const HEIGHT = 60;

const SVG = "http://www.w3.org/2000/svg";

/** Returns the histogram over the scale's range as a drawing. */
export function histogram(
  { absolute, signed }: Distribution,
  scale: ColorScale,
  isAbsolute: boolean,
): SVGSVGElement {
  const bins = histogramOf(isAbsolute ? absolute : signed, scale.low, scale.high, BINS);
  const tallest = Math.max(...bins) || 1;
  const colors = scale.stops(BINS);
  const drawing = document.createElementNS(SVG, "svg");
  drawing.setAttribute("viewBox", `0 0 ${BINS} ${HEIGHT}`);
  drawing.setAttribute("preserveAspectRatio", "none");
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", "Histogram of the deviation over A’s area");
  for (const [bin, fraction] of bins.entries()) {
    const height = (HEIGHT * fraction) / tallest;
    const bar = document.createElementNS(SVG, "rect");
    const sizes = { x: bin, y: HEIGHT - height, width: 1.02, height };
    for (const [name, size] of Object.entries(sizes)) bar.setAttribute(name, `${size}`);
    bar.setAttribute("fill", colors[bin]?.getStyle() ?? "none");
    drawing.append(bar);
  }
  return drawing;
}
