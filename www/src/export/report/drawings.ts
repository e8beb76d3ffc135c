// The report's drawings: the legend of a picture, and the histogram with its axes.

import { draw } from "../../common/drawing.ts";
import { BINS, binsOf } from "../../inspection/histogram.ts";
import { type Legend, ticksOf } from "../../inspection/legend.ts";
import { texts } from "../../texts/index.ts";

/** The sizes of the drawings in their own units. */
const LEGEND = { width: 150, height: 260, bar: 16, top: 12 };
const HISTOGRAM = { width: 640, height: 220, left: 52, bottom: 34, top: 8 };
/** Marks on the axis of areas. */
const AREA_TICKS = 4;

/** Returns an upright scale with its ticks. */
export function legendDrawing(legend: Legend): SVGElement {
  const { width, height, bar, top } = LEGEND;
  const { scale } = legend;
  const colors = scale.stops(BINS);
  const size = height - 2 * top;
  const y = (value: number) => top + (size * (scale.high - value)) / (scale.high - scale.low);
  const drawing = draw("svg", { viewBox: `0 0 ${width} ${height}`, class: "legend", role: "img" });
  drawing.setAttribute("aria-label", texts.report.legendOfTheColours);
  drawing.append(
    ...colors.map((color, bin) =>
      draw("rect", {
        ...{ x: 0, y: top + (size * (BINS - 1 - bin)) / BINS, width: bar },
        ...{ height: size / BINS + 0.3, fill: color.getStyle() },
      }),
    ),
    ...ticksOf(legend).flatMap(({ value, text }) => [
      draw("line", { x1: bar, x2: bar + 5, y1: y(value), y2: y(value), stroke: "#16202b" }),
      draw("text", { x: bar + 8, y: y(value) + 4 }, text),
    ]),
  );
  return drawing;
}

/** Returns the histogram: deviations across, percent of the area upwards. */
export function histogramDrawing(legend: Legend): SVGElement {
  const { width, height, left, bottom, top } = HISTOGRAM;
  const { scale, absolute, distributions, allowed } = legend;
  const bins = binsOf(distributions, scale, absolute);
  const largest = Math.max(...bins) || 1;
  const colors = scale.stops(BINS);
  const [across, up] = [width - left - 8, height - bottom - top];
  const x = (value: number) => left + (across * (value - scale.low)) / (scale.high - scale.low);
  const y = (fraction: number) => top + up * (1 - fraction / largest);
  const drawing = draw("svg", {
    viewBox: `0 0 ${width} ${height}`,
    class: "histogram",
    role: "img",
  });
  drawing.setAttribute("aria-label", texts.report.histogramOfTheDeviation);
  drawing.append(
    ...bins.map((fraction, bin) =>
      draw("rect", {
        ...{ x: left + (across * bin) / BINS, y: y(fraction), width: across / BINS },
        ...{ height: top + up - y(fraction), fill: colors[bin]?.getStyle() ?? "none" },
        ...{ stroke: "#55646f", "stroke-width": 0.4 },
      }),
    ),
    draw("line", { x1: left, x2: width - 8, y1: top + up, y2: top + up, stroke: "#16202b" }),
    draw("line", { x1: left, x2: left, y1: top, y2: top + up, stroke: "#16202b" }),
    ...Array.from({ length: AREA_TICKS + 1 }, (_, tick) => (largest * tick) / AREA_TICKS).flatMap(
      (fraction) => [
        draw("line", {
          x1: left - 4,
          x2: left,
          y1: y(fraction),
          y2: y(fraction),
          stroke: "#16202b",
        }),
        draw(
          "text",
          { x: left - 6, y: y(fraction) + 4, "text-anchor": "end" },
          `${(100 * fraction).toFixed(1)} %`,
        ),
      ],
    ),
    ...ticksOf(legend)
      .filter(({ kind }) => kind === "end" || kind === "zero")
      .map(({ value, text }) =>
        draw("text", { x: x(value), y: height - 16, "text-anchor": anchor(value, legend) }, text),
      ),
    ...(allowed === undefined ? [] : [allowed.above, ...(absolute ? [] : [-allowed.below])])
      .filter((value) => value >= scale.low && value <= scale.high)
      .map((value) =>
        draw("line", {
          ...{ x1: x(value), x2: x(value), y1: top, y2: top + up },
          ...{ stroke: "#b3142f", "stroke-dasharray": "4 3" },
        }),
      ),
    draw(
      "text",
      { x: left + across / 2, y: height - 2, "text-anchor": "middle" },
      texts.report.deviationShareOfTheArea,
    ),
  );
  return drawing;
}

/** The ends' texts stay within the drawing. */
function anchor(value: number, { scale }: Legend): string {
  if (value === scale.low) return "start";
  return value === scale.high ? "end" : "middle";
}
