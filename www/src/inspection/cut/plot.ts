// The deviation along a section: the cut of the painted models in its plane, and from it the
// deviations, enlarged.

import { Vector3 } from "three";
import { element } from "../../common/elements.ts";
import type { ColorScale } from "../../scene/colors/scale.ts";
import type { Cut } from "../../scene/section.ts";
import { texts } from "../../texts/index.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import { SIDES, type Side, type Sides } from "../../worker/protocol.ts";
import { type AxisTexts, drawAxes } from "./axes.ts";
import { forgetMeasured, measureOn } from "./measure.ts";

const figure = element("cut");
const factorInput = element("cut-scale", HTMLInputElement);
const SVG = "http://www.w3.org/2000/svg";
/** The part of the drawing's size that the largest deviation has at the scale 1. */
const UNIT = 0.05;

/** What is cut. */
export interface CutModels {
  maps: Sides<MapDisplay>;
  scale: ColorScale;
  largest: number;
  cut: Cut;
  /** A vertex of a map in scene coordinates. */
  place: (side: Side, vertex: number) => Vector3;
  /** The scene's origin in the coordinates of the models. */
  center: Vector3;
  /** The unit in which lengths are shown, if it is known. */
  unit: string | undefined;
}

/** A piece of a cut in the coordinates of its plane. */
export interface Piece {
  side: Side;
  from: Vertex;
  to: Vertex;
}

export interface Vertex {
  x: number;
  y: number;
  deviation: number;
}

let current: CutModels | undefined;
factorInput.addEventListener("input", () => showCut(current));

/** Shows a cut; without one, none. */
export function showCut(cut: CutModels | undefined): void {
  if (cut === undefined || !isSamePlane(cut, current)) forgetMeasured();
  current = cut;
  const pieces = cut === undefined ? [] : SIDES.flatMap((side) => piecesOf(cut, side));
  figure.hidden = pieces.length === 0;
  if (cut === undefined || pieces.length === 0) return;
  const all = pieces.flatMap(({ from, to }) => [from, to]);
  const range = (of: (vertex: Vertex) => number): [number, number] =>
    all.reduce(
      ([low, high], vertex) => [Math.min(low, of(vertex)), Math.max(high, of(vertex))],
      [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY],
    );
  const [[left, right], [bottom, top]] = [range(({ x }) => x), range(({ y }) => y)];
  const size = Math.max(right - left, top - bottom) || 1;
  const factor = (UNIT * size * 2 ** factorInput.valueAsNumber) / (cut.largest || 1);
  element("cut-factor").textContent = `× ${Number(factor.toPrecision(2))}`;
  const drawing = document.createElementNS(SVG, "svg");
  const margin = UNIT * size * 2 ** factorInput.valueAsNumber;
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", texts.places.theSectionWithItsDeviations);
  measureOn(drawing, pieces, { names: cut.cut.names, size });
  // Outwards is to the left along a piece, unless the plot shows the plane from behind.
  const facing = new Vector3().crossVectors(cut.cut.right, cut.cut.up);
  const side = Math.sign(facing.dot(cut.cut.plane.normal));
  for (const piece of pieces) drawing.prepend(...drawn(piece, side * factor, cut.scale));
  element("cut-plot").replaceChildren(drawing);
  const frame = {
    ...{ left: left - margin, right: right + margin },
    ...{ bottom: bottom - margin, top: top + margin },
  };
  drawAxes(drawing, frame, axisTexts(cut), [drawing.clientWidth, drawing.clientHeight]);
}

/** The names of the axes with their unit, and where the models' own coordinates begin. */
function axisTexts({ cut: { names, right, up }, center, unit }: CutModels): AxisTexts {
  const named = (name: string) => (unit === undefined ? name : `${name}, ${unit}`);
  return {
    names: [named(names[0]), named(names[1])],
    origin: [center.dot(right), center.dot(up)],
  };
}

/** Whether two cuts are of the same place, so that what was measured on one is on the other. */
const isSamePlane = (one: CutModels, other: CutModels | undefined): boolean =>
  other !== undefined && one.maps === other.maps && one.cut.plane.equals(other.cut.plane);

/** The pieces in which a plane meets the triangles of a map. */
function piecesOf({ maps, cut, place }: CutModels, side: Side): Piece[] {
  const map = maps[side];
  if (map === undefined) return [];
  const { indices, signed, distances } = map;
  const { plane, right, up } = cut;
  const heights = Float64Array.from(distances, (_, vertex) =>
    plane.distanceToPoint(place(side, vertex)),
  );
  const crossing = (one: number, other: number): Vertex => {
    const [from, to] = [heights[one] ?? 0, heights[other] ?? 0];
    const part = from / (from - to || 1);
    const point = place(side, one).lerp(place(side, other), part);
    const value = (vertex: number) => {
      const known = signed[vertex] ?? Number.NaN;
      return Number.isNaN(known) ? (distances[vertex] ?? 0) : known;
    };
    return {
      ...{ x: point.dot(right), y: point.dot(up) },
      deviation: value(one) + part * (value(other) - value(one)),
    };
  };
  const pieces: Piece[] = [];
  for (let first = 0; first < indices.length; first += 3) {
    const [a = 0, b = 0, c = 0] = indices.subarray(first, first + 3);
    const edges = [
      [a, b],
      [b, c],
      [c, a],
    ] as const;
    const isBelow = (vertex: number) => (heights[vertex] ?? 0) < 0;
    // Anticlockwise, a triangle is entered where it rises through the plane.
    const rising = edges.find(([from, to]) => isBelow(from) && !isBelow(to));
    const falling = edges.find(([from, to]) => !isBelow(from) && isBelow(to));
    if (rising !== undefined && falling !== undefined) {
      pieces.push({ side, from: crossing(...rising), to: crossing(...falling) });
    }
  }
  return pieces;
}

/** The piece itself, and the area between it and its deviations. */
function drawn({ from, to }: Piece, factor: number, scale: ColorScale): SVGElement[] {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const off = ({ x, y, deviation }: Vertex) =>
    `${x - (factor * deviation * dy) / length},${-(y + (factor * deviation * dx) / length)}`;
  const area = document.createElementNS(SVG, "polygon");
  area.setAttribute("points", `${from.x},${-from.y} ${to.x},${-to.y} ${off(to)} ${off(from)}`);
  area.setAttribute("fill", scale.color((from.deviation + to.deviation) / 2).getStyle());
  const line = document.createElementNS(SVG, "line");
  for (const [name, value] of Object.entries({ x1: from.x, y1: -from.y, x2: to.x, y2: -to.y })) {
    line.setAttribute(name, `${value}`);
  }
  return [area, line];
}
