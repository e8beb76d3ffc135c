import { FLOAT32_STEP } from "../common/float32.ts";
import { distanceText, grouped, signedText } from "../common/text/numbers.ts";
import type { Models } from "../scene/models.ts";
import { texts } from "../texts/index.ts";
import type { DisplayModel } from "../worker/protocol.ts";
import { type Edge, edgeNear, nearestOn } from "./edges.ts";
import { length, minus, type Vector } from "./fit/linear.ts";
import type { Measure, Place } from "./measures.ts";
import { fittedText, radiusOf } from "./radius.ts";
import { localOf, nameOf, SEPARATOR, unitText, type Value } from "./said.ts";

const own = texts.measuring;

/** What was measured; undefined where the models have no such place. */
export function measured(measure: Measure, models: Models): Value | undefined {
  if (measure.what === "points") return distanceOf(measure.places, models);
  const [place] = measure.places;
  const model = models.drawn[place.side];
  if (model === undefined || place.face >= model.faceCount) return undefined;
  if (measure.what === "radius") return radiusOf(model, place, models);
  return edgeOf(measure.what, model, place, models);
}

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
  // A component as small as the rounding of drawn points is 0.
  const components = way.toArray().map((at) => (Math.abs(at) > FLOAT32_STEP * diagonal ? at : 0));
  const parts = components.map((at, axis) => `${"xyz"[axis]} ${signedText(at, diagonal)}`);
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
    label: `≈ ${own.radiusLabel(distanceText(scale * radius, diagonal))}`,
    text: fittedText(scale * radius, own.circle, fit, diagonal),
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
