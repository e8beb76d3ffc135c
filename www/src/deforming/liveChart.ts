// A chart of the last seconds, drawn while results arrive.
import uPlot from "uplot";
import { pageColor } from "../common/pageColor.ts";

const HEIGHT = 190;
/** The seconds that are shown. */
const WINDOW = 10;

/** A line of the chart: its name, and its colour in the style sheet. */
export interface Line {
  label: string;
  color: string;
}

export class LiveChart {
  readonly #parent: HTMLElement;
  readonly #lines: readonly Line[];
  readonly #logarithmic: boolean;
  #rows: number[][] = [];
  #plot: uPlot;
  #drawing = false;

  constructor(parent: HTMLElement, lines: readonly Line[], { logarithmic = false } = {}) {
    this.#parent = parent;
    this.#lines = lines;
    this.#logarithmic = logarithmic;
    this.#plot = this.#build();
    new ResizeObserver(() => {
      this.#plot.setSize({ width: parent.clientWidth, height: HEIGHT });
    }).observe(parent);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.#plot.destroy();
      this.#plot = this.#build();
    });
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

  #build(): uPlot {
    const [ink, grid] = [pageColor("ink"), { stroke: pageColor("line"), width: 1 }];
    const axis: uPlot.Axis = { stroke: ink, grid, ticks: grid };
    const options: uPlot.Options = {
      width: this.#parent.clientWidth,
      height: HEIGHT,
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: {
          time: false,
          range: (_, __, high) => [Math.max(0, high - WINDOW), Math.max(WINDOW, high)],
        },
        y: this.#logarithmic ? { distr: 3 } : {},
      },
      axes: [{ ...axis, values: (_, splits) => splits.map((second) => `${second} s`) }, axis],
      series: [
        {},
        ...this.#lines.map(({ label, color }) => ({
          label,
          stroke: pageColor(color),
          width: 2,
          points: { show: false },
        })),
      ],
    };
    return new uPlot(options, this.#data(), this.#parent);
  }
}
