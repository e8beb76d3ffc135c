// The radius of a round face: certain of an exact surface, an estimate of one that fits drawn points.
import {
  distanceText,
  grouped,
  heldText,
  intervalText,
  shownLength,
  upperText,
} from "../common/text/numbers.ts";
import type { Models } from "../scene/models.ts";
import { texts } from "../texts/index.ts";
import type { DisplayModel } from "../worker/protocol.ts";
import { roundFace } from "./faces.ts";
import { along, dot, length, minus, type Vector } from "./fit/linear.ts";
import { type Fit, fromAxis } from "./fit/surfaces.ts";
import type { Place } from "./measures.ts";
import { localOf, nameOf, SEPARATOR, unitText, type Value } from "./said.ts";

const own = texts.measuring;

/** What is said of a radius that was fitted. */
export function fittedText(
  radius: number,
  what: string,
  fit: { residual: number; points: number },
  diagonal: number,
): string {
  const unit = unitText();
  const [one = "", two = ""] = [radius, 2 * radius].map((size) => distanceText(size, diagonal));
  return [
    `≈ ${own.radiusOf(one, two, unit)}`,
    what,
    own.fitted(grouped(fit.points), upperText(shownLength(fit.residual)), unit),
  ].join(SEPARATOR);
}

/** What is said of a radius that the exact surface has. */
function exactText(
  [lower, upper]: readonly [number, number],
  what: string,
  diagonal: number,
): string {
  const [one = "", two = ""] = [1, 2].map((times) =>
    heldText([times * lower, times * upper], diagonal),
  );
  const certain = own.certainRadius(intervalText(lower, upper, diagonal));
  return [own.radiusOf(one, two, unitText()), what, certain].join(SEPARATOR);
}

/** The radius of a face at a place; undefined where it lies on no round surface. */
export function radiusOf(model: DisplayModel, place: Place, models: Models): Value | undefined {
  const found = roundFace(model, place.face);
  if (found === undefined) return undefined;
  const { fit, points, radius: bounds } = found;
  const scale = place.side === "b" ? models.scale : 1;
  const at = localOf(model, place);
  const { radius, center } = roundAt(fit, at);
  const { diagonal } = models;
  const residual = scale * fit.residual;
  const what = kindText(fit, scale, diagonal);
  const common = {
    from: models.place(place.side, [...center]),
    to: models.place(place.side, [...at]),
    of: own.of(nameOf(model, place)),
  };
  if (bounds !== undefined) {
    const scaled = [scale * bounds[0], scale * bounds[1]] as const;
    const label = own.radiusLabel(heldText(scaled, diagonal));
    return { ...common, text: exactText(scaled, what, diagonal), label };
  }
  const label = `≈ ${own.radiusLabel(distanceText(scale * radius, diagonal))}`;
  if (points !== undefined) {
    return {
      ...common,
      text: fittedText(scale * radius, what, { residual, points }, diagonal),
      label,
    };
  }
  const [one = "", two = ""] = [1, 2].map((times) =>
    distanceText(times * scale * radius, diagonal),
  );
  const certain = own.certainCone(upperText(shownLength(residual)), unitText());
  const text = [`≈ ${own.radiusOf(one, two, unitText())}`, what, certain].join(SEPARATOR);
  return { ...common, text, label };
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
