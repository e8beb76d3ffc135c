// Measuring on the plot of a section: the deviation under the pointer, and the distance of two
// points of the contours. Contours are those of the drawn triangles, so that numbers are estimates.

import { draw } from "../../common/drawing.ts";
import { element } from "../../common/elements.ts";
import { distanceText, signedText } from "../../common/text/numbers.ts";
import { commonUnit } from "../../files/units.ts";
import { texts } from "../../texts/index.ts";
import type { Side } from "../../worker/protocol.ts";
import type { Piece, Vertex } from "./contours.ts";

/** Pixels within which a point is taken, and those within which it is a corner. */
const REACH = 24;
const SNAP = 8;
/** The distance of ends that are one, in sizes of the section: positions are in float32. */
const SAME = 1e-5;
/** The sine of the angle from which on pieces meet in a corner. */
const CORNER_SINE = Math.sin((20 * Math.PI) / 180);
/** The radius of a mark, in pixels. */
const RADIUS = 4;

const output = element("cut-measured");

interface Point {
  x: number;
  y: number;
}

/** A point of a contour. */
interface Picked extends Vertex {
  side: Side;
}

/** The names of the directions of the plot, and the size of the section that digits refer to. */
interface Plotted {
  names: readonly [string, string];
  size: number;
}

let picked: Picked[] = [];
/** Ends what listens to the drawing for the section before. */
let listening = new AbortController();

/** Forgets the points that were picked, since the section is another one. */
export function forgetMeasured(): void {
  picked = [];
}

/** Lets points of the pieces be picked on a drawing in their coordinates, with y downwards. */
export function measureOn(
  drawing: SVGSVGElement,
  pieces: readonly Piece[],
  plotted: Plotted,
): void {
  listening.abort();
  listening = new AbortController();
  const { signal } = listening;
  let corners: readonly Picked[] | undefined;
  const show = (hovered?: Picked) => {
    output.textContent = textOf(hovered, plotted);
    const scale = pixelsOf(drawing);
    const points = hovered === undefined || picked.length === 2 ? picked : [...picked, hovered];
    drawing.replaceChildren(...marksOf(points, scale));
  };
  const at = ({ clientX, clientY }: PointerEvent) => {
    const matrix = drawing.getScreenCTM();
    if (matrix === null) return undefined;
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
    corners ??= cornersOf(pieces, plotted.size);
    return nearest(pieces, corners, { x, y: -y }, matrix.a);
  };
  drawing.addEventListener("pointermove", (event) => show(at(event)), { signal });
  drawing.addEventListener("pointerleave", () => show(), { signal });
  drawing.addEventListener(
    "click",
    (event) => {
      const point = at(event as PointerEvent);
      if (point === undefined) picked = [];
      else picked = picked.length === 1 ? [...picked, point] : [point];
      show();
    },
    { signal },
  );
  // Once the plot has its size.
  queueMicrotask(() => show());
}

/** The point of the pieces that is nearest to a place; a corner where one is near. */
function nearest(
  pieces: readonly Piece[],
  corners: readonly Picked[],
  { x, y }: Point,
  scale: number,
) {
  const away = (one: Point) => Math.hypot(one.x - x, one.y - y) * scale;
  const near = corners.filter((corner) => away(corner) < SNAP);
  if (near.length > 0) return near.reduce((one, two) => (away(two) < away(one) ? two : one));
  let best: Picked | undefined;
  let least = REACH;
  for (const { side, from, to } of pieces) {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const along = ((x - from.x) * dx + (y - from.y) * dy) / (dx * dx + dy * dy || 1);
    const part = Math.max(0, Math.min(1, along));
    const between = (name: keyof Vertex) => from[name] + part * (to[name] - from[name]);
    const point = { side, x: between("x"), y: between("y"), deviation: between("deviation") };
    if (away(point) >= least) continue;
    least = away(point);
    best = point;
  }
  return best;
}

/** The corners of the contours: ends in which pieces of different directions meet. O(n). */
function cornersOf(pieces: readonly Piece[], size: number): Picked[] {
  const found = new Map<string, { corner: Picked; angle: number; isCorner: boolean }>();
  for (const { side, from, to } of pieces) {
    const angle = Math.atan2(to.y - from.y, to.x - from.x);
    for (const end of [from, to]) {
      const key = [side, ...[end.x, end.y].map((at) => Math.round(at / (SAME * size)))].join();
      const before = found.get(key);
      if (before === undefined) {
        found.set(key, { corner: { side, ...end }, angle, isCorner: false });
        continue;
      }
      before.isCorner ||= Math.abs(Math.sin(angle - before.angle)) > CORNER_SINE;
      if (Math.abs(end.deviation) > Math.abs(before.corner.deviation)) {
        before.corner.deviation = end.deviation;
      }
    }
  }
  return [...found.values()].flatMap(({ corner, isCorner }) => (isCorner ? [corner] : []));
}

function textOf(hovered: Picked | undefined, { names: [across, up], size }: Plotted): string {
  const unit = commonUnit();
  const measured = (text: string) => `≈ ${text}${unit === undefined ? "" : ` ${unit}`}`;
  const [first, second = hovered] = picked;
  if (first !== undefined && second !== undefined) {
    const [dx, dy] = [second.x - first.x, second.y - first.y];
    const along = `${across} ${signedText(dx, size)}, ${up} ${signedText(dy, size)}`;
    const sides = [first, second].map(({ side }) => side.toUpperCase()).join(texts.places.to);
    return texts.places.from(measured(distanceText(Math.hypot(dx, dy), size)), sides, along);
  }
  const point = first ?? hovered;
  if (point === undefined) return texts.places.pointAtTheContourClick;
  const deviation = `${point.side.toUpperCase()} ${measured(signedText(point.deviation, size))}`;
  return first === undefined ? deviation : texts.places.clickASecondPoint(deviation);
}

/** Pixels in a unit of the drawing. */
const pixelsOf = (drawing: SVGSVGElement): number => drawing.getScreenCTM()?.a || 1;

function marksOf(points: Picked[], scale: number): SVGElement[] {
  const dots = points.map(({ x, y }) => draw("circle", { cx: x, cy: -y, r: RADIUS / scale }));
  const [first, second] = points;
  if (first === undefined || second === undefined) return dots;
  const line = `M${first.x},${-first.y}L${second.x},${-second.y}`;
  return [draw("path", { d: line }), ...dots];
}
