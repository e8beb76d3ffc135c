// The histogram of the deviation over the area, with axes: deviations to the right, shares of the
// area upwards, linear or logarithmic. An estimate, as the map is.

import uPlot from "uplot";
import { element } from "../common/elements.ts";
import { pageColor } from "../common/pageColor.ts";
import { axisNumber } from "../common/plots/axisNumber.ts";
import { axisOf, plotIn } from "../common/plots/plot.ts";
import { shownLength } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import { BINS, binsOf } from "./histogram.ts";
import type { Legend } from "./legend.ts";

/** The height of the plot, in CSS pixels. */
const HEIGHT = 150;
/** The least share that a logarithmic axis shows: less is as high as a pixel. */
const LEAST = 1e-4;
/** CSS pixels that the numbers take to the left and below, and that those below are apart at least. */
const AXES = { left: 44, below: 24, apart: 56 };
/** CSS pixels of the lines at what is allowed: their width, and their dashes. */
const LINE = 1;
const DASHES = [3, 2];

const figure = element("distribution");
const logarithmic = element("distribution-log", HTMLInputElement);

let current: Legend | undefined;
let plot: uPlot | undefined;
logarithmic.addEventListener("input", (event) => {
  event.stopPropagation();
  plot?.destroy();
  plot = undefined;
  if (current !== undefined) showDistribution(current);
});

/** Shows the distribution of what a legend is about. */
export function showDistribution(legend: Legend): void {
  current = legend;
  const { scale, absolute, distributions } = legend;
  const bins = binsOf(distributions, scale, absolute);
  const width = (scale.high - scale.low) / BINS;
  const middles = bins.map((_, bin) => shownLength(scale.low + (bin + 0.5) * width));
  plot ??= makePlot(logarithmic.checked);
  plot.setData([middles, bins.map((share) => (share > 0 ? Math.max(share, LEAST) : null))]);
}

function makePlot(isLogarithmic: boolean): uPlot {
  figure.setAttribute("aria-label", texts.places.sharesOfTheAreaBy);
  const ends = (): [number, number] =>
    current ? [shownLength(current.scale.low), shownLength(current.scale.high)] : [0, 1];
  const bars = uPlot.paths.bars?.({
    // As wide as bins.
    size: [1, Number.POSITIVE_INFINITY],
    disp: {
      fill: {
        unit: 3,
        values: () => (current?.scale.stops(BINS) ?? []).map((color) => color.getStyle()),
      },
    },
  });
  return plotIn(
    figure,
    {
      legend: { show: true },
      cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
      scales: {
        x: { time: false, range: ends },
        y: isLogarithmic
          ? { distr: 3, range: [LEAST / 2, 1] }
          : { range: (_, __, highest) => [0, highest] },
      },
      axes: [
        axisOf({ size: AXES.below, space: AXES.apart, grid: { show: false } }),
        axisOf({ size: AXES.left, values: (_, splits) => splits.map(shareText) }),
      ],
      series: [
        { label: texts.places.deviation, value: (_, value) => axisNumber(value) },
        {
          label: texts.places.shareOfTheArea,
          value: (_, share) => (share === null ? "" : `≈ ${percent(share)}`),
          ...(bars && { paths: bars }),
          // Bars have colours of their own without a contour only.
          width: 0,
          points: { show: false },
        },
      ],
      hooks: { draw: [drawLimits] },
    },
    [[], []],
    () => HEIGHT,
  );
}

/** Draws lines at what is allowed. */
function drawLimits(drawn: uPlot): void {
  if (current?.allowed === undefined) return;
  const { allowed, absolute, scale } = current;
  const { ctx, bbox } = drawn;
  ctx.save();
  ctx.strokeStyle = pageColor("ink");
  ctx.lineWidth = LINE * devicePixelRatio;
  ctx.setLineDash(DASHES.map((length) => length * devicePixelRatio));
  ctx.beginPath();
  for (const limit of [allowed.above, ...(absolute ? [] : [-allowed.below])]) {
    if (limit < scale.low || limit > scale.high) continue;
    const x = drawn.valToPos(shownLength(limit), "x", true);
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
  }
  ctx.stroke();
  ctx.restore();
}

/** A share at the axis; ticks between decades have none. */
const shareText = (share: number | null): string => (share === null ? "" : percent(share));

function percent(share: number): string {
  const value = 100 * share;
  if (value === 0 || value >= 1) return `${Number(value.toFixed(value < 10 ? 1 : 0))} %`;
  return `${Number(value.toPrecision(1))} %`;
}
