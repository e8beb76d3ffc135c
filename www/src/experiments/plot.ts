// One panel on a canvas, drawn again as points come in.
import uPlot from "uplot";
import { axisNumber } from "./axis-number.ts";
import { markFailures } from "./failure-marks.ts";
import type { Curve } from "./outcome.ts";
import type { Panel, Series } from "./panels.ts";

/** Colours of CSS. */
export interface Look {
  ink: string;
  grid: string;
  /** The colour of a method. */
  of(method: string): string;
}

/** Pixels. */
const HEIGHT = 290;
const POINT = 5;
const BOUND_POINT = 3;
const DASHES = [8, 5];
/** Part of the axis that is left free at its ends. */
const ROOM = 0.03;
/** Of the logarithm of a power of ten, from a whole number. */
const ROUNDING = 1e-9;

export class Plot {
  readonly #panel: Panel;
  readonly #positions: readonly number[];
  readonly #curves: readonly Curve[];
  readonly #parent: HTMLElement;
  readonly #look: Look;
  readonly #plot: uPlot;
  readonly #resized: ResizeObserver;

  /** `onCursor` hears the index of the position that is pointed at. */
  constructor(
    parent: HTMLElement,
    panel: Panel,
    positions: readonly number[],
    curves: readonly Curve[],
    look: Look,
    onCursor: (index: number) => void,
  ) {
    this.#panel = panel;
    this.#positions = positions;
    this.#curves = curves;
    this.#parent = parent;
    this.#look = look;
    this.#plot = new uPlot(this.#options(onCursor), this.#data(), parent);
    this.#resized = new ResizeObserver(() => {
      this.#plot.setSize({ width: parent.clientWidth, height: HEIGHT });
    });
    this.#resized.observe(parent);
  }

  /** Draws what the curves have now. */
  update(): void {
    this.#plot.setData(this.#data());
  }

  dispose(): void {
    this.#resized.disconnect();
    this.#plot.destroy();
  }

  #data(): uPlot.AlignedData {
    const drawn = (value: number | null | undefined) =>
      value == null || (this.#panel.logarithmic && value <= 0) ? null : value;
    const values = this.#panel
      .series(this.#curves)
      .map(({ values }) => this.#positions.map((_, index) => drawn(values[index])));
    return [[...this.#positions], ...values];
  }

  #options(onCursor: (index: number) => void): uPlot.Options {
    const grid = { stroke: this.#look.grid, width: 1 };
    const decades: uPlot.Axis.Filter = (_, splits) =>
      this.#panel.logarithmic ? splits.map(wholeDecade) : splits;
    const coarse = { ...grid, filter: decades };
    const axis: uPlot.Axis = {
      stroke: this.#look.ink,
      grid,
      ticks: grid,
      values: (_, splits) => splits.map(axisNumber),
      labelSize: 20,
      labelFont: "12px system-ui, sans-serif",
    };
    return {
      width: this.#parent.clientWidth,
      height: HEIGHT,
      legend: { show: false },
      cursor: { sync: { key: "position" }, drag: { x: false, y: false }, y: false },
      scales: {
        x: { time: false, range: (_, low, high) => widened(low, high) },
        y: this.#panel.logarithmic ? { distr: 3 } : {},
      },
      axes: [
        { ...axis, label: "position of A’s centre from B’s, model units", size: 32 },
        { ...axis, label: this.#panel.unit, size: 58, grid: coarse, ticks: coarse },
      ],
      series: [{}, ...this.#panel.series(this.#curves).map((series) => this.#drawn(series))],
      hooks: {
        setCursor: [({ cursor: { idx } }) => idx != null && onCursor(idx)],
        draw: this.#panel.marksFailures
          ? [(plot) => markFailures(plot, this.#curves, this.#look.of)]
          : [],
      },
    };
  }

  #drawn({ name, method, dashed }: Series): uPlot.Series {
    return {
      label: name,
      stroke: this.#look.of(method),
      width: dashed ? 1 : 2,
      ...(dashed ? { dash: DASHES } : {}),
      points: { show: true, size: dashed ? BOUND_POINT : POINT, fill: this.#look.of(method) },
    };
  }
}

/** The tick if it is a power of ten, within the rounding of the steps to it. */
function wholeDecade(tick: number): number | null {
  const decade = Math.log10(tick);
  return Math.abs(decade - Math.round(decade)) < ROUNDING ? tick : null;
}

function widened(low: number, high: number): [number, number] {
  const room = ROOM * (high - low);
  return [low - room, high + room];
}
