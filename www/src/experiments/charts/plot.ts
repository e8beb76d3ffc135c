// One panel, drawn on a canvas and updated as results arrive.

import type uPlot from "uplot";
import { axisOf, type PlotOptions, plotIn } from "../../common/plots/plot.ts";
import { texts } from "../../texts/index.ts";
import type { Curve } from "../sweep/sweepPoint.ts";
import { markFailures } from "./failureMarks.ts";
import type { Panel, Series } from "./panels.ts";

/** The colour of a method, as a CSS value. */
export type ColorOf = (method: string) => string;

/** Sizes in pixels. */
const HEIGHT = 290;
const POINT = 5;
const BOUND_POINT = 3;
const DASHES = [8, 5];
/** The margin at the ends of the axis, as a fraction of the range of positions. */
const MARGIN = 0.03;
/** The largest rounding error of the logarithm of a power of ten. */
const ROUNDING = 1e-9;

export class Plot {
  readonly #panel: Panel;
  readonly #positions: readonly number[];
  readonly #curves: readonly Curve[];
  readonly #colorOf: ColorOf;
  readonly #plot: uPlot;

  /** Calls `onCursor` with the index of the position under the pointer. */
  constructor(
    parent: HTMLElement,
    panel: Panel,
    positions: readonly number[],
    curves: readonly Curve[],
    colorOf: ColorOf,
    onCursor: (index: number) => void,
  ) {
    this.#panel = panel;
    this.#positions = positions;
    this.#curves = curves;
    this.#colorOf = colorOf;
    this.#plot = plotIn(parent, this.#options(onCursor), this.#data(), () => HEIGHT);
  }

  /** Draws the results that have arrived. */
  update(): void {
    this.#plot.setData(this.#data());
  }

  dispose(): void {
    this.#plot.destroy();
  }

  #data(): uPlot.AlignedData {
    const drawable = (value: number | null | undefined) =>
      value == null || (this.#panel.logarithmic && value <= 0) ? null : value;
    const values = this.#panel
      .series(this.#curves)
      .map(({ values }) => this.#positions.map((_, index) => drawable(values[index])));
    return [[...this.#positions], ...values];
  }

  #options(onCursor: (index: number) => void): PlotOptions {
    const decades: uPlot.Axis.Filter = (_, splits) =>
      this.#panel.logarithmic ? splits.map(wholeDecade) : splits;
    const axis = axisOf({ labelSize: 20, labelFont: "12px system-ui, sans-serif" });
    const coarse = { ...axis.grid, filter: decades };
    return {
      cursor: { sync: { key: "position" }, drag: { x: false, y: false }, y: false },
      scales: {
        x: { time: false, range: (_, low, high) => withMargin(low, high) },
        y: this.#panel.logarithmic ? { distr: 3 } : {},
      },
      axes: [
        { ...axis, label: texts.experiments.positionOfA, size: 32 },
        { ...axis, label: this.#panel.unit, size: 58, grid: coarse, ticks: coarse },
      ],
      series: [{}, ...this.#panel.series(this.#curves).map((series) => this.#style(series))],
      hooks: {
        setCursor: [({ cursor: { idx } }) => idx != null && onCursor(idx)],
        draw: this.#panel.marksFailures
          ? [(plot) => markFailures(plot, this.#curves, this.#colorOf)]
          : [],
      },
    };
  }

  #style({ name, method, dashed }: Series): uPlot.Series {
    return {
      label: name,
      stroke: this.#colorOf(method),
      width: dashed ? 1 : 2,
      ...(dashed ? { dash: DASHES } : {}),
      points: { show: true, size: dashed ? BOUND_POINT : POINT, fill: this.#colorOf(method) },
    };
  }
}

/** Returns the tick if it is a power of ten up to rounding, else null. */
function wholeDecade(tick: number): number | null {
  const decade = Math.log10(tick);
  return Math.abs(decade - Math.round(decade)) < ROUNDING ? tick : null;
}

function withMargin(low: number, high: number): [number, number] {
  const margin = MARGIN * (high - low);
  return [low - margin, high + margin];
}
