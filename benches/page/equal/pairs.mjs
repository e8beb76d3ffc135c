// Pairs of files of all formats that are written here, and of those in examples and in a folder of models.
import { existsSync, readFileSync } from "node:fs";
import { box } from "../../../tests/page/support/boxes.mjs";

/** The corners and triangles of a box, its faces outwards. */
function solid([x, y, z], at = [0, 0, 0]) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => [
    at[0] + (corner & 1 ? x : 0),
    at[1] + (corner & 2 ? y : 0),
    at[2] + (corner & 4 ? z : 0),
  ]);
  const sides = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  const triangles = sides.flatMap(([a, b, c, d]) => [
    [a, b, c],
    [a, c, d],
  ]);
  return { corners, triangles };
}

const lines = (rows) => rows.map((row) => row.join(" ")).join("\n");

/** The text of a box in each format. */
const WRITERS = {
  json: (size, at = [0, 0, 0]) =>
    JSON.stringify({
      unit: 1e-3,
      surfaces: box(
        "block",
        at,
        at.map((low, axis) => low + size[axis]),
      ),
    }),
  stl(size, at) {
    const { corners, triangles } = solid(size, at);
    const facets = triangles.map(
      (triangle) =>
        `facet normal 0 0 0\nouter loop\n${triangle.map((corner) => `vertex ${corners[corner].join(" ")}`).join("\n")}\nendloop\nendfacet`,
    );
    return `solid box\n${facets.join("\n")}\nendsolid box\n`;
  },
  obj(size, at) {
    const { corners, triangles } = solid(size, at);
    const faces = triangles.map((triangle) => ["f", ...triangle.map((corner) => corner + 1)]);
    return `${lines(corners.map((corner) => ["v", ...corner]))}\n${lines(faces)}\n`;
  },
  off(size, at) {
    const { corners, triangles } = solid(size, at);
    return `OFF\n8 12 0\n${lines(corners)}\n${lines(triangles.map((triangle) => [3, ...triangle]))}\n`;
  },
  ply(size, at) {
    const { corners, triangles } = solid(size, at);
    const head = `ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\nelement face 12\nproperty list uchar int vertex_indices\nend_header`;
    return `${head}\n${lines(corners)}\n${lines(triangles.map((triangle) => [3, ...triangle]))}\n`;
  },
  vtk(size, at) {
    const { corners, triangles } = solid(size, at);
    return `# vtk DataFile Version 3.0\nbox\nASCII\nDATASET POLYDATA\nPOINTS 8 double\n${lines(corners)}\nPOLYGONS 12 48\n${lines(triangles.map((triangle) => [3, ...triangle]))}\n`;
  },
  xyz: (size, at) => `${lines(points(size, at))}\n`,
  pts: (size, at) => `${points(size, at).length}\n${lines(points(size, at))}\n`,
  csv: (size, at) =>
    `x,y,z\n${points(size, at)
      .map((row) => row.join(","))
      .join("\n")}\n`,
};

/** Points on a box, as a scan has them. */
function points([x, y, z], at = [0, 0, 0]) {
  const steps = [0, 0.25, 0.5, 0.75, 1];
  return steps
    .flatMap((u) => steps.flatMap((v) => [0, 1].map((w) => [u * x, v * y, w * z])))
    .map((point) => point.map((value, axis) => value + at[axis]));
}

const file = (name, text) => ({ name, bytes: Buffer.from(text) });

const read = (path) => ({ name: path.split("/").at(-1), bytes: readFileSync(path) });

/** Changes from one box to the other: its size, its place. */
const CHANGES = [
  [[4, 3, 2.25], undefined],
  [
    [4, 3, 2],
    [0.125, 0, 0.03125],
  ],
  [[4.0078125, 3, 2], undefined],
];

/** Returns the pairs: `[a, b]`, each with a name and its bytes; `models` is a folder with more, or none. */
export function pairs(models) {
  const all = [];
  for (const format of Object.keys(WRITERS)) {
    for (const [size, at] of CHANGES) {
      const a = file(`a.${format}`, WRITERS[format]([4, 3, 2]));
      all.push([a, file(`b.${format}`, WRITERS[format](size, at))]);
    }
  }
  // Exact CAD against what was made or scanned of it.
  for (const format of Object.keys(WRITERS).filter((name) => name !== "json")) {
    const [size, at] = CHANGES[1];
    all.push([
      file(`scan.${format}`, WRITERS[format](size, at)),
      file("b.json", WRITERS.json([4, 3, 2])),
    ]);
  }
  const parts = ["a.step", "b.step"].map((name) => read(`examples/parts/${name}`));
  all.push(parts, [parts[1], parts[0]]);
  const brep = read("python/tests/files/square.brep");
  all.push([brep, file("b.json", WRITERS.json([4, 3, 2]))]);
  for (const [a, b] of [
    ["iges/bearing.iges.gz", "iges/bearing.iges.gz"],
    ["step/linkrods.step.gz", "step/linkrods.step.gz"],
  ]) {
    if (models && existsSync(`${models}/${a}`)) all.push([a, b].map((name) => read(`${models}/${name}`)));
  }
  return all;
}
