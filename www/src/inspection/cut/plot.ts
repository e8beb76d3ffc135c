// The deviation along a section: its contours, and from them the deviations, enlarged, on axes with the
// coordinates of the models in the unit shown.

import { Vector3 } from "three";
import type uPlot from "uplot";
import { draw } from "../../common/drawing.ts";
import { element } from "../../common/elements.ts";
import { pageColor } from "../../common/pageColor.ts";
import { axisOf, plotIn } from "../../common/plots/plot.ts";
import { distanceText, shownLength } from "../../common/text/numbers.ts";
import type { ColorScale } from "../../scene/colors/scale.ts";
import type { Cut } from "../../scene/section.ts";
import { texts } from "../../texts/index.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import type { Sides } from "../../worker/protocol.ts";
import type { Piece, Vertex } from "./contours.ts";
import { type Frame, fitted, frameOf } from "./frame.ts";
import { forgetMeasured, measureOn } from "./measure.ts";

const figure = element("cut");
const parent = element("cut-plot");
const factorInput = element("cut-scale", HTMLInputElement);
/** The part of the drawing's size that the largest deviation has at the scale 1. */
const UNIT = 0.05;
/** CSS pixels that the numbers take to the left of the plot and below it, and the room above and to the right. */
const AXES = { left: 44, below: 24 };
const PADDING = 8;
/** CSS pixels between ticks at least. */
const APART = { across: 52, up: 28 };
/** The width of a contour, in CSS pixels. */
const LINE = 1.2;

/** Contours are no function of a coordinate: uPlot scales and draws axes only. */
const NO_DATA: uPlot.AlignedData = [
  [0, 1],
  [null, null],
];

/** A section with its contours. */
export interface ShownCut {
  cut: Cut;
  maps: Sides<MapDisplay>;
  pieces: readonly Piece[];
  scale: ColorScale;
  /** The largest deviation, which determines how far deviations are enlarged. */
  largest: number;
  /** The scene's origin in the coordinates of the models. */
  center: Vector3;
  /** The unit in which lengths are shown, if it is known. */
  unit: string | undefined;
}

/** What is plotted: a section, the box of its contours, and how far deviations are enlarged. */
interface Plotted extends ShownCut {
  box: Frame;
  size: number;
  margin: number;
  factor: number;
}

let current: ShownCut | undefined;
let plotted: Plotted | undefined;
let plot: uPlot | undefined;
factorInput.addEventListener("input", () => showCut(current));

/** Shows a section; without one, or where it meets nothing, none. */
export function showCut(shown: ShownCut | undefined): void {
  if (shown === undefined || !isSamePlace(shown, current)) forgetMeasured();
  current = shown;
  plotted = shown && plottedOf(shown);
  figure.hidden = plotted === undefined;
  if (plotted === undefined) return;
  const { size, factor, pieces, cut } = plotted;
  element("cut-factor").textContent = `× ${Number(factor.toPrecision(2))}`;
  parent.setAttribute("aria-label", labelOf(plotted));
  plot ??= makePlot();
  plot.setData(NO_DATA);
  measureOn(overlayOf(plot), pieces, { names: cut.names, size });
}

/** Whether two sections are of the same place, so that what was measured on one is on the other. */
const isSamePlace = (one: ShownCut, other: ShownCut | undefined): boolean =>
  other !== undefined && one.maps === other.maps && one.cut.plane.equals(other.cut.plane);

function plottedOf(shown: ShownCut): Plotted | undefined {
  const box = frameOf(shown.pieces.flatMap(({ from, to }) => [from, to]));
  if (box === undefined) return undefined;
  const size = Math.max(box.right - box.left, box.top - box.bottom) || 1;
  const margin = UNIT * size * 2 ** factorInput.valueAsNumber;
  return { ...shown, box, size, margin, factor: margin / (shown.largest || 1) };
}

function labelOf({ box: { left, right, bottom, top }, size, unit = "" }: Plotted): string {
  const [width, height] = [right - left, top - bottom].map((length) => distanceText(length, size));
  return texts.places.theSectionWithItsDeviations(width, height, unit);
}

function makePlot(): uPlot {
  const height = () => Number.parseFloat(getComputedStyle(parent).height) || 1;
  const range = (of: (frame: Frame) => readonly [number, number], axis: 0 | 1) => (): Range => {
    if (plotted === undefined) return [0, 1];
    const { center, cut } = plotted;
    const origin = center.dot(axis === 0 ? cut.right : cut.up);
    const [low, high] = of(frameIn(plotted));
    return [shownLength(low + origin), shownLength(high + origin)];
  };
  return plotIn(
    parent,
    {
      cursor: { show: false },
      padding: [PADDING, PADDING, 0, 0],
      scales: {
        x: { time: false, range: range(({ left, right }) => [left, right], 0) },
        y: { range: range(({ bottom, top }) => [bottom, top], 1) },
      },
      axes: [
        axisOf({ size: AXES.below, space: APART.across }),
        axisOf({ size: AXES.left, space: APART.up, scale: "y" }),
      ],
      series: [{}, { scale: "y" }],
      hooks: { draw: [drawContours], setSize: [(resized) => void overlayOf(resized)] },
    },
    NO_DATA,
    height,
  );
}

type Range = [number, number];

/** What is seen of the plane. */
const frameIn = ({ box, margin }: Plotted): Frame =>
  fitted(box, margin, [
    parent.clientWidth - AXES.left - PADDING,
    parent.clientHeight - AXES.below - PADDING,
  ]);

/** A drawing over the plot in the coordinates of the plane, with y downwards. */
function overlayOf({ over }: uPlot): SVGSVGElement {
  const drawing = over.querySelector("svg") ?? over.appendChild(draw("svg", {}) as SVGSVGElement);
  if (plotted === undefined) return drawing;
  const { left, right, bottom, top } = frameIn(plotted);
  drawing.setAttribute("viewBox", [left, -top, right - left, top - bottom].join(" "));
  return drawing;
}

/** Draws the contours and the areas between them and their deviations, and names the directions. */
function drawContours({ ctx, bbox }: uPlot): void {
  if (plotted === undefined) return;
  const { pieces, cut, factor, scale, unit } = plotted;
  const { left, top, right } = frameIn(plotted);
  const pixel = bbox.width / (right - left);
  const at = ({ x, y }: { x: number; y: number }) =>
    [bbox.left + (x - left) * pixel, bbox.top + (top - y) * pixel] as const;
  // Outwards is to the left along a piece, unless the plot shows the plane from behind.
  const facing = new Vector3().crossVectors(cut.right, cut.up);
  const outwards = Math.sign(facing.dot(cut.plane.normal)) * factor;
  ctx.save();
  for (const { from, to } of pieces) {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const length = Math.hypot(dx, dy) || 1;
    const off = ({ x, y, deviation }: Vertex) => ({
      x: x - (outwards * deviation * dy) / length,
      y: y + (outwards * deviation * dx) / length,
    });
    ctx.fillStyle = scale.color((from.deviation + to.deviation) / 2).getStyle();
    ctx.beginPath();
    for (const corner of [from, to, off(to), off(from)]) ctx.lineTo(...at(corner));
    ctx.fill();
  }
  ctx.beginPath();
  for (const { from, to } of pieces) {
    ctx.moveTo(...at(from));
    ctx.lineTo(...at(to));
  }
  ctx.lineWidth = LINE * devicePixelRatio;
  ctx.strokeStyle = pageColor("ink");
  ctx.stroke();
  nameDirections(ctx, bbox, cut.names, unit);
  ctx.restore();
}

/** Writes the names of the directions at the ends of the axes. */
function nameDirections(
  ctx: CanvasRenderingContext2D,
  { left, top, width, height }: uPlot.BBox,
  names: readonly [string, string],
  unit: string | undefined,
): void {
  const [across, up] = names.map((name) => (unit === undefined ? name : `${name}, ${unit}`));
  const gap = PADDING * 0.5 * devicePixelRatio;
  ctx.font = `italic ${ctx.font}`;
  ctx.fillStyle = pageColor("soft");
  ctx.textBaseline = "bottom";
  ctx.textAlign = "right";
  ctx.fillText(across ?? "", left + width, top + height - gap);
  ctx.textBaseline = "top";
  ctx.textAlign = "left";
  ctx.fillText(up ?? "", left + gap, top);
}
