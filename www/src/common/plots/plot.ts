// Plots in the colours of the page, as wide as the element that they are in.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { pageColor } from "../pageColor.ts";
import { axisNumber } from "./axisNumber.ts";

/** What the numbers of axes are written in, in CSS pixels. */
const FONT = "10.5px system-ui, sans-serif";

/** Returns an axis in the colours of the page, which are asked for at each drawing. */
export function axisOf(axis: uPlot.Axis): uPlot.Axis {
  const line = { stroke: () => pageColor("line"), width: 1 };
  return {
    ...{ stroke: () => pageColor("soft"), grid: line, ticks: line, font: FONT },
    values: (_, splits) => splits.map(axisNumber),
    ...axis,
  };
}

/** A plot's options but its size. */
export type PlotOptions = Omit<uPlot.Options, "width" | "height">;

/**
 * Adds a plot to an element, of its width and of a height in CSS pixels that may change with the window. It is drawn
 * anew in another width, and when the page turns light or dark.
 */
export function plotIn(
  parent: HTMLElement,
  { hooks = {}, ...options }: PlotOptions,
  data: uPlot.AlignedData,
  height: () => number,
): uPlot {
  const size = () => ({ width: Math.max(1, parent.clientWidth), height: height() });
  const end = new AbortController();
  const destroy = [...(hooks.destroy ?? []), () => end.abort()];
  const plot = new uPlot(
    { legend: { show: false }, ...options, hooks: { ...hooks, destroy }, ...size() },
    data,
    parent,
  );
  const resized = new ResizeObserver(() => {
    const { width, height } = size();
    if (width !== plot.width || height !== plot.height) plot.setSize({ width, height });
  });
  resized.observe(parent);
  end.signal.addEventListener("abort", () => resized.disconnect());
  onScheme(() => plot.redraw(), end.signal);
  return plot;
}

/** Calls back when the page turns light or dark, by the system or by the user's choice. */
function onScheme(callback: () => void, signal: AbortSignal): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", callback, { signal });
  const chosen = new MutationObserver(callback);
  chosen.observe(document.documentElement, { attributeFilter: ["data-theme"] });
  signal.addEventListener("abort", () => chosen.disconnect());
}
