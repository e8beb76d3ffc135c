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
