// Models as files for the page, and files of the shared models.
import { existsSync, readFileSync } from "node:fs";

/** A square of side 2 at this height, with its normal upwards. */
const square = (height) => ({
  degree: [1, 1],
  knots_u: [0, 0, 1, 1],
  knots_v: [0, 0, 1, 1],
  ctrl: [-1, 1].map((x) => [-1, 1].map((y) => [x, y, height, 1])),
});

/** A model of one square at each height. */
export const planes = (...heights) => ({ surfaces: heights.map(square) });

/** A model of squares of side 2 in a row along x, each at its height; none overlaps another. */
export const row = (...heights) => ({
  surfaces: heights.map((height, index) => {
    const { ctrl, ...rest } = square(height);
    const moved = ctrl.map((column) => column.map(([x, ...others]) => [x + 3 * index, ...others]));
    return { ...rest, ctrl: moved };
  }),
});

/** x, y and weight of the control points of a circular arc, `quarters` quarter turns from an angle (The NURBS Book, section 7.5). */
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

/** A small rotation about an axis other than the sphere's own. */
function turned([x, y, z]) {
  const [cos, sin] = [Math.cos(0.2), Math.sin(0.2)];
  const [a, b] = [cos * x - sin * y, sin * x + cos * y];
  return [a, cos * b - sin * z, sin * b + cos * z];
}

/** A part of a sphere: quarter turns from an angle in longitude, and from an angle in latitude. */
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
 * A rotated quarter of a sphere of radius 2, and three quarters of a concentric
 * sphere of radius 2.2. All points of the first are at the distance 0.2 from
 * the second, which only ever smaller cells can certify: minutes at 1e-9.
 */
export const sphereParts = {
  a: spherePart(2, [0.75 * Math.PI, 1], [-0.25 * Math.PI, 1], turned),
  b: spherePart(2.2, [0, 3], [-0.5 * Math.PI, 2], (point) => point),
};

/** A bilinear face with these corners in turn. */
const face = ([a, b, c, d]) => ({
  degree: [1, 1],
  knots_u: [0, 0, 1, 1],
  knots_v: [0, 0, 1, 1],
  ctrl: [
    [a, b],
    [d, c],
  ].map((row) => row.map((corner) => [...corner, 1])),
});

/** The cube [-half, half]³. */
export const cube = (half) => ({
  surfaces: [0, 1, 2].flatMap((axis) =>
    [-half, half].map((end) => {
      const corner = (u, v) => [0, 1, 2].map((k) => [end, u, v][(k - axis + 3) % 3]);
      return face([
        corner(-half, -half),
        corner(half, -half),
        corner(half, half),
        corner(-half, half),
      ]);
    }),
  ),
});

/** The tetrahedron with every second corner of that cube. */
export function tetrahedron(half) {
  const corners = [
    [half, half, half],
    [half, -half, -half],
    [-half, half, -half],
    [-half, -half, half],
  ];
  const triangle = (left) => corners.filter((_, index) => index !== left);
  return { surfaces: corners.map((_, left) => face([...triangle(left), triangle(left)[2]])) };
}

/** A cylinder of radius 2 about z from -1 to 1, with a bore of radius 1 if so asked. */
export function cylinder({ bored }) {
  const ruled = ([inner, low], [outer, high]) => ({
    degree: [2, 1],
    knots_u: knots(4),
    knots_v: [0, 0, 1, 1],
    ctrl: arc(0, 4).map(([x, y, w]) => [
      [inner * x, inner * y, low, w],
      [outer * x, outer * y, high, w],
    ]),
  });
  const hole = bored ? 1 : 0;
  const caps = [-1, 1].map((z) => ruled([hole, z], [2, z]));
  const walls = (bored ? [1, 2] : [2]).map((radius) => ruled([radius, -1], [radius, 1]));
  return { surfaces: [...caps, ...walls] };
}

/** The STEP text of squares of side 1 in a row, each a face of its own shell's body. */
export function stepSquares(count, width = 1) {
  const lines = [];
  const add = (entity) => {
    lines.push(`#${lines.length + 1}=${entity};`);
    return `#${lines.length}`;
  };
  const point = (x, y) => add(`CARTESIAN_POINT('',(${x}.,${y}.,0.))`);
  const direction = (...xyz) => add(`DIRECTION('',(${xyz.map((value) => `${value}.`).join()}))`);
  const [up, along] = [direction(0, 0, 1), direction(1, 0, 0)];
  const faces = Array.from({ length: count }, (_, index) => {
    const [x, y] = [2 * (index % width), 2 * Math.floor(index / width)];
    const corners = [point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)];
    const vertices = corners.map((corner) => add(`VERTEX_POINT('',${corner})`));
    const edges = corners.map((corner, at) => {
      const [dx, dy] = [
        [1, 0],
        [0, 1],
        [-1, 0],
        [0, -1],
      ][at];
      const line = add(`LINE('',${corner},${add(`VECTOR('',${direction(dx, dy, 0)},1.)`)})`);
      const ends = `${vertices[at]},${vertices[(at + 1) % 4]}`;
      return add(`ORIENTED_EDGE('',*,*,${add(`EDGE_CURVE('',${ends},${line},.T.)`)},.T.)`);
    });
    const bound = add(`FACE_OUTER_BOUND('',${add(`EDGE_LOOP('',(${edges}))`)},.T.)`);
    const plane = add(`PLANE('',${add(`AXIS2_PLACEMENT_3D('',${corners[0]},${up},${along})`)})`);
    return add(`ADVANCED_FACE('square ${index}',(${bound}),${plane},.T.)`);
  });
  const shell = add(`OPEN_SHELL('',(${faces}))`);
  const body = add(`SHELL_BASED_SURFACE_MODEL('',(${shell}))`);
  const millimetre = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const context = add(
    `(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((${millimetre}))REPRESENTATION_CONTEXT('',''))`,
  );
  add(`MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(${body}),${context})`);
  return `ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n${lines.join("\n")}\nENDSEC;\nEND-ISO-10303-21;\n`;
}

/** A file with this text, for Playwright's file inputs. */
export const file = (name, text) => ({
  name,
  mimeType: "application/json",
  buffer: Buffer.from(text),
});

export const modelFile = (name, model) => file(name, JSON.stringify(model));

/** A file of ../shared/models, or undefined if it does not exist. */
export function sharedFile(name) {
  const path = new URL(`../../../../shared/models/${name}`, import.meta.url);
  return existsSync(path) ? file(name, readFileSync(path)) : undefined;
}
