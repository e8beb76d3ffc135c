// A chart of the last seconds, drawn while results arrive.
import type uPlot from "uplot";
import { pageColor } from "../common/pageColor.ts";
import { axisOf, plotIn } from "../common/plots/plot.ts";

const HEIGHT = 190;
/** The seconds that are shown. */
const WINDOW = 10;

/** A line of the chart: its name, and its colour in the style sheet. */
export interface Line {
  label: string;
  color: string;
}

export class LiveChart {
  readonly #lines: readonly Line[];
  #rows: number[][] = [];
  readonly #plot: uPlot;
  #drawing = false;

  constructor(parent: HTMLElement, lines: readonly Line[], { logarithmic = false } = {}) {
    this.#lines = lines;
    const seconds: uPlot.Axis.Values = (_, splits) => splits.map((second) => `${second} s`);
    this.#plot = plotIn(
      parent,
      {
        cursor: { show: false },
        scales: {
          x: {
            time: false,
            range: (_, __, high) => [Math.max(0, high - WINDOW), Math.max(WINDOW, high)],
          },
          y: logarithmic ? { distr: 3 } : {},
        },
        axes: [axisOf({ values: seconds }), axisOf({})],
        series: [
          {},
          ...lines.map(({ label, color }) => ({
            label,
            stroke: () => pageColor(color),
            width: 2,
            points: { show: false },
          })),
        ],
      },
      this.#data(),
      () => HEIGHT,
    );
  }

  /** Adds the lines' values at a time in seconds, later than the last. */
  add(time: number, values: readonly number[]): void {
    this.#rows.push([time, ...values]);
    const first = this.#rows.findIndex(([at = 0]) => at >= time - WINDOW);
    this.#rows.splice(0, first);
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => {
      this.#drawing = false;
      this.#plot.setData(this.#data());
    });
  }

  clear(): void {
    this.#rows = [];
    this.#plot.setData(this.#data());
  }

  #data(): uPlot.AlignedData {
    const column = (index: number) => this.#rows.map((row) => row[index] ?? 0);
    return [column(0), ...this.#lines.map((_, index) => column(index + 1))];
  }
}
