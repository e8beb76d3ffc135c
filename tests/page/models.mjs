// Models as files, and where the models made by others are.
import { existsSync, readFileSync } from "node:fs";

/** A square of side 2 in the plane of this height, its normal upwards. */
const square = (height) => ({
  degree: [1, 1],
  knots_u: [0, 0, 1, 1],
  knots_v: [0, 0, 1, 1],
  ctrl: [-1, 1].map((x) => [-1, 1].map((y) => [x, y, height, 1])),
});

/** One square at each height. */
export const planes = (...heights) => ({ surfaces: heights.map(square) });

/** x, y and w of an arc's control points, `quarters` from an angle on (The NURBS Book, section 7.5). */
const arc = (from, quarters) =>
  Array.from({ length: 2 * quarters + 1 }, (_, eighth) => {
    const [angle, corner] = [from + (eighth * Math.PI) / 4, eighth % 2 === 1];
    const [size, weight] = corner ? [Math.SQRT2, Math.SQRT1_2] : [1, 1];
    return [size * Math.cos(angle), size * Math.sin(angle), weight];
  });

const knots = (quarters) => {
  const inner = Array.from({ length: 2 * (quarters - 1) }, (_, index) => 1 + Math.floor(index / 2));
  return [0, 0, 0, ...inner, quarters, quarters, quarters];
};

/** Turned a little about an axis that is none of the sphere's. */
function turned([x, y, z]) {
  const [cos, sin] = [Math.cos(0.2), Math.sin(0.2)];
  const [a, b] = [cos * x - sin * y, sin * x + cos * y];
  return [a, cos * b - sin * z, sin * b + cos * z];
}

/** Quarters of a sphere round from an angle on, and along from a latitude on. */
function spherePart(radius, [round, rounds], [along, alongs], turn) {
  const ctrl = arc(round, rounds).map(([x, y, weight]) =>
    arc(along, alongs).map(([out, up, weightAlong]) => {
      const point = [radius * out * x, radius * out * y, radius * up];
      return [...turn(point), weight * weightAlong];
    }),
  );
  const surface = { degree: [2, 2], knots_u: knots(rounds), knots_v: knots(alongs), ctrl };
  return { surfaces: [surface] };
}

/**
 * A quarter of a sphere of radius 2 around -x, turned, and three quarters of
 * one of 2.2 around it: 0.2 from each other all over, which nothing but ever
 * smaller cells tells. Minutes at 1e-9.
 */
export const sphereParts = {
  a: spherePart(2, [0.75 * Math.PI, 1], [-0.25 * Math.PI, 1], turned),
  b: spherePart(2.2, [0, 3], [-0.5 * Math.PI, 2], (point) => point),
};

/** What a file input takes for a file of this text. */
export const file = (name, text) => ({
  name,
  mimeType: "application/json",
  buffer: Buffer.from(text),
});

export const modelFile = (name, model) => file(name, JSON.stringify(model));

/** A file of ../shared/models, if that folder is there. */
export function sharedFile(name) {
  const path = new URL(`../../../shared/models/${name}`, import.meta.url);
  return existsSync(path) ? file(name, readFileSync(path)) : undefined;
}
