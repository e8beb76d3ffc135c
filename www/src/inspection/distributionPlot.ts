// The histogram of the deviation over the area, with axes: deviations to the right, shares of the
// area upwards, linear or logarithmic. An estimate, as the map is.

import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import { BINS, binsOf } from "./histogram.ts";
import type { Legend } from "./legend.ts";

const SVG = "http://www.w3.org/2000/svg";
/** The drawing's size, and the margins in which the axes are labelled. */
const [WIDTH, HEIGHT] = [320, 150];
const MARGIN = { left: 42, right: 10, top: 8, bottom: 22 };
/** The least share that a logarithmic axis shows, and its steps. */
const LEAST = 1e-4;
const DECADES = [1e-4, 1e-3, 1e-2, 0.1, 1] as const;
/** The steps of a linear axis, of which the one with the fewest lines above two is taken. */
const STEPS = [0.5, 0.25, 0.2, 0.1, 0.05, 0.02, 0.01] as const;
/** Pixels that two labels of the lower axis are apart at least. */
const APART = 72;

const figure = element("distribution");
const logarithmic = element("distribution-log", HTMLInputElement);

let current: Legend | undefined;
logarithmic.addEventListener("input", (event) => {
  event.stopPropagation();
  if (current !== undefined) showDistribution(current);
});

/** Shows the distribution of what a legend is about. */
export function showDistribution(legend: Legend): void {
  current = legend;
  const { scale, absolute, distributions } = legend;
  const bins = binsOf(distributions, scale, absolute);
  const largest = Math.max(...bins) || 1;
  const ticks = logarithmic.checked ? DECADES : linearTicks(largest);
  const top = logarithmic.checked ? 1 : Math.max(largest, ticks.at(-1) ?? 0);
  const height = HEIGHT - MARGIN.top - MARGIN.bottom;
  const up = (share: number): number => {
    const part = logarithmic.checked
      ? 1 - Math.log(Math.max(share, LEAST)) / Math.log(LEAST)
      : share / top;
    return MARGIN.top + height * (1 - part);
  };
  const across = (value: number): number =>
    MARGIN.left +
    ((WIDTH - MARGIN.left - MARGIN.right) * (value - scale.low)) / (scale.high - scale.low || 1);
  const drawing = node("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
  drawing.setAttribute("aria-label", texts.places.sharesOfTheAreaBy);
  drawing.append(...ticks.flatMap((share) => shareTick(share, up(share))));
  drawing.append(...bars(bins, legend, across, up), ...valueTicks(legend, across));
  figure.replaceChildren(drawing);
}

function linearTicks(largest: number): number[] {
  const step = STEPS.find((one) => largest / one >= 2) ?? 0.01;
  return Array.from({ length: Math.floor(largest / step) + 1 }, (_, index) => index * step);
}

function bars(
  bins: readonly number[],
  { scale }: Legend,
  across: (value: number) => number,
  up: (share: number) => number,
): SVGElement[] {
  const colors = scale.stops(BINS);
  const edge = (bin: number) => across(scale.low + (bin / BINS) * (scale.high - scale.low));
  return bins.flatMap((share, bin) => {
    if (share === 0) return [];
    // Little area is seen too.
    const y = Math.min(up(share), HEIGHT - MARGIN.bottom - 1);
    const bar = node("rect", {
      ...{ x: edge(bin), y, width: edge(bin + 1) - edge(bin) },
      ...{ height: HEIGHT - MARGIN.bottom - y, fill: colors[bin]?.getStyle() ?? "none" },
    });
    const title = node("title", {});
    title.textContent = `≈ ${percent(share)}`;
    bar.append(title);
    return [bar];
  });
}

function shareTick(share: number, y: number): SVGElement[] {
  const text = node("text", { x: MARGIN.left - 6, y: y + 3.5, "text-anchor": "end" });
  text.textContent = percent(share);
  return [node("line", { x1: MARGIN.left, x2: WIDTH - MARGIN.right, y1: y, y2: y }), text];
}

/** The ends of the scale, zero and what is allowed, which has a line; those without room are left out. */
function valueTicks(
  { scale, absolute, allowed, diagonal }: Legend,
  across: (value: number) => number,
): SVGElement[] {
  const limits =
    allowed === undefined ? [] : [allowed.above, ...(absolute ? [] : [-allowed.below])];
  const inside = (value: number) => scale.low <= value && value <= scale.high;
  const lines = limits.filter(inside).map((value) => {
    const x = across(value);
    return node("line", {
      ...{ x1: x, x2: x, y1: MARGIN.top, y2: HEIGHT - MARGIN.bottom, class: "limit" },
    });
  });
  const placed: number[] = [];
  const texts = [scale.low, scale.high, ...limits, 0].filter(inside).flatMap((value) => {
    const x = across(value);
    if (placed.some((other) => Math.abs(other - x) < APART)) return [];
    placed.push(x);
    const anchor = value === scale.high ? "end" : value === scale.low ? "start" : "middle";
    const text = node("text", { x, y: HEIGHT - 6, "text-anchor": anchor });
    text.textContent =
      absolute || value === 0 ? distanceText(value, diagonal) : signedText(value, diagonal);
    return [text];
  });
  return [...lines, ...texts];
}

function percent(share: number): string {
  const value = 100 * share;
  if (value === 0 || value >= 1) return `${Number(value.toFixed(value < 10 ? 1 : 0))} %`;
  return `${Number(value.toPrecision(1))} %`;
}

function node(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, `${value}`);
  return made;
}
