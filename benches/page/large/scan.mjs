// Writes a sheet with waves: of many triangles as a binary STL, 84 bytes and 50 a triangle, or of many points as text.
import { closeSync, openSync, writeFileSync, writeSync } from "node:fs";

/** The bytes of an STL's header, its count and of one triangle. */
const HEADER = 80;
const COUNT = 4;
const TRIANGLE = 50;

/** The side of the sheet in mm, the length of a wave and its height. */
const SIDE = 100;
const WAVE = 25;
const HEIGHT = 5;
/** The decimals of coordinates as text. */
const DECIMALS = 5;

/** The corner of a cell of `cells` along a side. */
function cornerOf(cells, lift, i, j) {
  const [x, y] = [i, j].map((index) => (SIDE * index) / cells);
  const z = HEIGHT * Math.sin((2 * Math.PI * x) / WAVE) * Math.cos((2 * Math.PI * y) / WAVE);
  return [x, y, z + lift];
}

/** Writes a sheet of `cells`² points, `lift` mm above z = 0. */
export function writePoints(path, cells, lift) {
  const lines = Array.from({ length: cells * cells }, (_, index) => {
    const point = cornerOf(cells, lift, Math.floor(index / cells), index % cells);
    return point.map((value) => value.toFixed(DECIMALS)).join(" ");
  });
  writeFileSync(path, lines.join("\n"));
}

/** Writes a sheet of 2 · `cells`² triangles, `lift` mm above z = 0. */
export function writeScan(path, cells, lift) {
  const count = 2 * cells * cells;
  const bytes = Buffer.alloc(HEADER + COUNT + TRIANGLE * count);
  bytes.writeUInt32LE(count, HEADER);
  let at = HEADER + COUNT;
  const corner = (i, j) => cornerOf(cells, lift, i, j);
  const triangle = (...corners) => {
    // The normal stays zero: readers take it from the corners.
    at += 12;
    for (const value of corners.flat()) at = bytes.writeFloatLE(value, at);
    at += 2;
  };
  for (let i = 0; i < cells; i++) {
    for (let j = 0; j < cells; j++) {
      const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
      triangle(a, b, c);
      triangle(a, c, d);
    }
  }
  const file = openSync(path, "w");
  writeSync(file, bytes);
  closeSync(file);
}
