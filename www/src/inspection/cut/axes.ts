// The axes of a section's plot: coordinates along both directions of its plane, in the unit shown.
import { shownLength } from "../../common/text/numbers.ts";

/** Pixels that the numbers take to the left of the plot and below it. */
const LEFT = 40;
const BELOW = 20;
/** The height of the numbers, their distance from the axis, and the length of a tick, in pixels. */
const FONT = 10;
const PAD = 3;
const TICK = 4;
/** Pixels between ticks at least, so that numbers do not touch. */
const APART = { across: 52, up: 28 };
/** What a step between ticks may be, times a power of ten. */
const STEPS: readonly number[] = [1, 2, 5, 10];
/** Two numbers in a plot are the same place if they differ by less than this part of a step. */
const SAME = 1e-6;
const SVG = "http://www.w3.org/2000/svg";

/** The rectangle that is plotted, in the plane's coordinates with y upwards. */
export interface Frame {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** What the axes say. */
export interface AxisTexts {
  /** The names of the directions. */
  names: readonly [string, string];
  /** What is added to coordinates of the plot for those of the models. */
  origin: readonly [number, number];
}

/** Shows a frame in the drawing, which has this many pixels, with axes to the left and below. */
export function drawAxes(
  drawing: SVGSVGElement,
  frame: Frame,
  texts: AxisTexts,
  [width, height]: readonly [number, number],
): void {
  const { left, right, bottom, top } = frame;
  const scale = Math.min(
    Math.max(1, width - LEFT) / (right - left),
    Math.max(1, height - BELOW) / (top - bottom),
  );
  const pixel = 1 / scale;
  const box = [
    left - LEFT * pixel,
    -top,
    right - left + LEFT * pixel,
    top - bottom + BELOW * pixel,
  ];
  drawing.setAttribute("viewBox", box.join(" "));
  const group = document.createElementNS(SVG, "g");
  group.classList.add("axes");
  group.setAttribute("font-size", `${FONT * pixel}`);
  const lines = [`M${left},${-top}V${-bottom}H${right}`];
  const [across, up] = texts.origin;
  for (const { at, text } of ticks([left, right], across, APART.across * pixel)) {
    lines.push(`M${at},${-bottom}v${TICK * pixel}`);
    const y = -bottom + (TICK + PAD + FONT) * pixel;
    group.append(label(text, at, y, "middle"));
  }
  for (const { at, text } of ticks([bottom, top], up, APART.up * pixel)) {
    lines.push(`M${left},${-at}h${-TICK * pixel}`);
    const [x, y] = [left - (TICK + PAD) * pixel, -at + (FONT / 3) * pixel];
    group.append(label(text, x, y, "end"));
  }
  const [nameAcross, nameUp] = texts.names;
  group.append(label(nameAcross, right, -bottom - PAD * pixel, "end", "axis-name"));
  group.append(label(nameUp, left + PAD * pixel, -top + FONT * pixel, "start", "axis-name"));
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", lines.join(""));
  group.append(path);
  drawing.prepend(group);
}

/** Round coordinates of the models in the unit shown, and where they are in the plot. */
export function ticks(
  [from, to]: readonly [number, number],
  origin: number,
  apart: number,
): { at: number; text: string }[] {
  const unit = shownLength(1);
  const [low, high, least] = [(from + origin) * unit, (to + origin) * unit, apart * unit];
  if (!(high > low) || !(least > 0)) return [];
  const power = 10 ** Math.floor(Math.log10(least));
  const step = power * (STEPS.find((one) => one * power >= least) ?? 10);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + SAME));
  const found: { at: number; text: string }[] = [];
  for (let index = Math.ceil(low / step - SAME); index * step <= high + SAME * step; index++) {
    const text = (index * step).toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
    found.push({ at: (index * step) / unit - origin, text: text.replace("-", "−") });
  }
  return found;
}

function label(text: string, x: number, y: number, anchor: string, name = ""): SVGElement {
  const node = document.createElementNS(SVG, "text");
  for (const [key, value] of Object.entries({ x, y, "text-anchor": anchor, class: name })) {
    node.setAttribute(key, `${value}`);
  }
  node.textContent = text;
  return node;
}
