// The numbers of what was measured, from the models as they stand. They are of drawn triangles and edges: estimates,
// and said to be.
import type { Vector3 } from "three";
import {
  distanceText,
  grouped,
  shownLength,
  signedText,
  upperText,
} from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import type { Models } from "../scene/models.ts";
import { texts } from "../texts/index.ts";
import type { DisplayModel } from "../worker/protocol.ts";
import { type Edge, edgeNear, nearestOn } from "./edges.ts";
import { faceFit } from "./faces.ts";
import { along, dot, length, minus, type Vector } from "./fit/linear.ts";
import { type Fit, fromAxis } from "./fit/surfaces.ts";
import type { Measure, Place } from "./measures.ts";

/** What is said of a measurement, and the arrow that shows it, in the scene. */
export interface Value {
  text: string;
  label: string;
  from: Vector3;
  to: Vector3;
  /** Which faces it is of. */
  of: string;
}

const own = texts.measuring;

const unitText = (): string => commonUnit() ?? own.modelUnits;

/** What was measured; undefined where the models have no such place. */
export function measured(measure: Measure, models: Models): Value | undefined {
  if (measure.what === "points") return distanceOf(measure.places, models);
  const [place] = measure.places;
  const model = models.drawn[place.side];
  if (model === undefined || place.face >= model.faceCount) return undefined;
  if (measure.what === "radius") return radiusOf(model, place, models);
  return edgeOf(measure.what, model, place, models);
}

/** A place in its tessellation's coordinates. */
const localOf = (model: DisplayModel, place: Place): Vector =>
  minus(place.point, model.tessellation.origin);

const nameOf = (model: DisplayModel, { side, face }: Place): string =>
  `${side.toUpperCase()} ${model.faceNames[face] ?? face}`;

function distanceOf([first, second]: readonly [Place, Place], models: Models): Value | undefined {
  const ends = [first, second].map((place) => {
    const model = models.drawn[place.side];
    if (model === undefined || place.face >= model.faceCount) return undefined;
    return { model, at: models.place(place.side, [...localOf(model, place)]) };
  });
  const [from, to] = ends;
  if (from === undefined || to === undefined) return undefined;
  const way = to.at.clone().sub(from.at);
  const { diagonal } = models;
  const size = distanceText(way.length(), diagonal);
  const parts = way.toArray().map((part, axis) => `${"xyz"[axis]} ${signedText(part, diagonal)}`);
  const isFacing = [first, second].every(({ normal }) => normal.some((at) => at !== 0));
  const angle = models
    .turn(first.side, first.normal)
    .angleTo(models.turn(second.side, second.normal));
  const degrees = ((angle * 180) / Math.PI).toFixed(1);
  const said = [own.about(size, unitText()), ...parts, ...(isFacing ? [own.turned(degrees)] : [])];
  return {
    ...{ text: said.join(SEPARATOR), label: `≈ ${size}`, from: from.at, to: to.at },
    of: own.from(nameOf(from.model, first), nameOf(to.model, second)),
  };
}

const SEPARATOR = " · ";

/** What is said of a radius: its own, and that it is fitted. */
function radiusText(
  radius: number,
  what: string,
  fit: { residual: number; points: number },
  diagonal: number,
): string {
  const unit = unitText();
  const [one, two] = [radius, 2 * radius].map((size) => distanceText(size, diagonal));
  return [
    own.radiusOf(one ?? "", two ?? "", unit),
    what,
    own.fitted(grouped(fit.points), upperText(shownLength(fit.residual)), unit),
  ].join(SEPARATOR);
}

function radiusOf(model: DisplayModel, place: Place, models: Models): Value | undefined {
  const found = faceFit(model, place.face);
  if (found === undefined) return undefined;
  const { fit, points } = found;
  const scale = place.side === "b" ? models.scale : 1;
  const at = localOf(model, place);
  const { radius, center } = roundAt(fit, at);
  const { diagonal } = models;
  const residual = scale * fit.residual;
  const what = kindText(fit, scale, diagonal);
  return {
    text: radiusText(scale * radius, what, { residual, points }, diagonal),
    label: own.radiusLabel(distanceText(scale * radius, diagonal)),
    from: models.place(place.side, [...center]),
    to: models.place(place.side, [...at]),
    of: own.of(nameOf(model, place)),
  };
}

function kindText(fit: Fit, scale: number, diagonal: number): string {
  if (fit.kind === "cone") return own.cone(((fit.angle * 180) / Math.PI).toFixed(2));
  if (fit.kind === "torus")
    return own.torus(distanceText(scale * fit.around, diagonal), unitText());
  return fit.kind === "sphere" ? own.sphere : own.cylinder;
}

/** The radius at a point, and the point that it is measured from. */
function roundAt(fit: Fit, at: Vector): { radius: number; center: Vector } {
  if (fit.kind === "sphere") return fit;
  const { center, axis } = fit;
  const up = dot(minus(at, center), axis);
  const foot = along(center, up, axis);
  if (fit.kind === "cylinder") return { radius: fit.radius, center: foot };
  if (fit.kind === "cone") return { radius: fromAxis(at, center, axis), center: foot };
  const out = minus(at, foot);
  return { radius: fit.radius, center: along(center, fit.around / (length(out) || 1), out) };
}

function edgeOf(
  what: "circle" | "edge",
  model: DisplayModel,
  place: Place,
  models: Models,
): Value | undefined {
  const at = localOf(model, place);
  const edge = edgeAt(model, place);
  if (edge === undefined) return undefined;
  const scale = place.side === "b" ? models.scale : 1;
  const near = nearestOf(edge, at);
  const common = { of: own.of(nameOf(model, place)), to: models.place(place.side, [...near]) };
  const { diagonal } = models;
  if (what === "edge") {
    const size = distanceText(scale * edge.length, diagonal);
    return {
      ...{ ...common, from: common.to, label: `≈ ${size}` },
      text: [own.edgeLength(size, unitText()), ...partsText(edge)].join(SEPARATOR),
    };
  }
  if (edge.circle === undefined) return undefined;
  const { radius, residual, center } = edge.circle;
  const points = edge.points.length;
  const fit = { residual: scale * residual, points };
  return {
    ...common,
    from: models.place(place.side, [...center]),
    label: own.radiusLabel(distanceText(scale * radius, diagonal)),
    text: radiusText(scale * radius, own.circle, fit, diagonal),
  };
}

/** The edges of places, which are asked for at each drawing. */
const edges = new WeakMap<Place, { model: DisplayModel; edge: Edge | undefined }>();

function edgeAt(model: DisplayModel, place: Place): Edge | undefined {
  const before = edges.get(place);
  if (before?.model === model) return before.edge;
  const edge = edgeNear(model, place.face, localOf(model, place))?.edge;
  edges.set(place, { model, edge });
  return edge;
}

function partsText({ points, circle, isClosed }: Edge): string[] {
  const parts = grouped(points.length - 1);
  const said = circle === undefined ? own.drawnEdge(parts) : own.roundEdge(parts);
  return isClosed ? [said, own.closed] : [said];
}

/** The point of an edge that is nearest to a point. */
function nearestOf({ points }: Edge, at: Vector): Vector {
  const feet = points.slice(1).map((to, index) => nearestOn(at, [points[index] ?? to, to]));
  return feet.reduce(
    (best, one) => (length(minus(one, at)) < length(minus(best, at)) ? one : best),
    points[0] ?? at,
  );
}
