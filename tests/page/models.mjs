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

/** x, y and w of a circle's control points (The NURBS Book, section 7.5). */
const circle = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((eighth) => {
  const [angle, corner] = [(eighth * Math.PI) / 4, eighth % 2 === 1];
  const [size, weight] = corner ? [Math.SQRT2, Math.SQRT1_2] : [1, 1];
  return [size * Math.cos(angle), size * Math.sin(angle), weight];
});

/** How far a point of an uneven sphere of radius 2 or so is off, and another's with it, at most. */
export const UNEVEN = 1e-7;

/** A sphere whose control points are off by 1e-8 of its size, so that none knows it for a sphere. */
export function unevenSphere(radius) {
  const uneven = (i, j) => radius * (1 + 1e-8 * Math.sin(i + j / radius));
  const ctrl = circle.map(([x, y, around], i) =>
    [...circle.slice(6, 8), ...circle.slice(0, 3)].map(([out, up, along], j) => {
      const scale = uneven(i, j);
      return [scale * out * x, scale * out * y, scale * up, around * along];
    }),
  );
  const knots_u = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4];
  return { surfaces: [{ degree: [2, 2], knots_u, knots_v: [0, 0, 0, 1, 1, 2, 2, 2], ctrl }] };
}

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
