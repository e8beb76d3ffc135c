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

/** The lines of a square of side 1 with its lower left corner at x, as a shell's body; `color` may be three numbers. */
function stepSquare(add, x, name, color) {
  const corners = [
    [x, 0],
    [x + 1, 0],
    [x + 1, 1],
    [x, 1],
  ].map(([x, y]) => add(`CARTESIAN_POINT('',(${x}.,${y}.,0.))`));
  const direction = (...xyz) => add(`DIRECTION('',(${xyz.map((value) => `${value}.`).join()}))`);
  const vertices = corners.map((corner) => add(`VERTEX_POINT('',${corner})`));
  const ways = [
    [1, 0],
    [0, 1],
    [-1, 0],
    [0, -1],
  ];
  const edges = corners.map((corner, at) => {
    const vector = add(`VECTOR('',${direction(...ways[at], 0)},1.)`);
    const line = add(`LINE('',${corner},${vector})`);
    const ends = `${vertices[at]},${vertices[(at + 1) % 4]}`;
    return add(`ORIENTED_EDGE('',*,*,${add(`EDGE_CURVE('',${ends},${line},.T.)`)},.T.)`);
  });
  const bound = add(`FACE_OUTER_BOUND('',${add(`EDGE_LOOP('',(${edges}))`)},.T.)`);
  const axes = add(
    `AXIS2_PLACEMENT_3D('',${corners[0]},${direction(0, 0, 1)},${direction(1, 0, 0)})`,
  );
  const face = add(`ADVANCED_FACE('${name}',(${bound}),${add(`PLANE('',${axes})`)},.T.)`);
  if (color !== undefined) {
    const rgb = add(`COLOUR_RGB('',${color.join()})`);
    const area = add(`FILL_AREA_STYLE('',(${add(`FILL_AREA_STYLE_COLOUR('',${rgb})`)}))`);
    const side = add(`SURFACE_SIDE_STYLE('',(${add(`SURFACE_STYLE_FILL_AREA(${area})`)}))`);
    const style = add(
      `PRESENTATION_STYLE_ASSIGNMENT((${add(`SURFACE_STYLE_USAGE(.BOTH.,${side})`)}))`,
    );
    add(`STYLED_ITEM('',(${style}),${face})`);
  }
  return face;
}

/**
 * The STEP text of an assembly of two levels: `machine` has two pumps, one of them called `spare`, and
 * a pump two squares `in / out` with the faces `low` and `high`, of which the first may have a colour.
 */
export function stepAssembly({ color } = {}) {
  const lines = [];
  const add = (entity) => {
    lines.push(`#${lines.length + 1}=${entity};`);
    return `#${lines.length}`;
  };
  const millimetre = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const context = add(
    `(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((${millimetre}))REPRESENTATION_CONTEXT('',''))`,
  );
  const product = (name, items) => {
    const shape = add(`SHAPE_REPRESENTATION('',(${items}),${context})`);
    const formation = add(
      `PRODUCT_DEFINITION_FORMATION('','',${add(`PRODUCT('id','${name}','',())`)})`,
    );
    const definition = add(`PRODUCT_DEFINITION('','',${formation},$)`);
    add(
      `SHAPE_DEFINITION_REPRESENTATION(${add(`PRODUCT_DEFINITION_SHAPE('','',${definition})`)},${shape})`,
    );
    return [shape, definition];
  };
  const placement = (y) => {
    const [up, along] = ["(0.,0.,1.)", "(1.,0.,0.)"].map((xyz) => add(`DIRECTION('',${xyz})`));
    return add(`AXIS2_PLACEMENT_3D('',${add(`CARTESIAN_POINT('',(0.,${y}.,0.))`)},${up},${along})`);
  };
  const place = ([part, inner], [whole, outer], y, name) => {
    const map = add(`ITEM_DEFINED_TRANSFORMATION('','',${placement(0)},${placement(y)})`);
    const relation = add(
      `(REPRESENTATION_RELATIONSHIP('','',${part},${whole})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(${map})SHAPE_REPRESENTATION_RELATIONSHIP())`,
    );
    const use = add(`NEXT_ASSEMBLY_USAGE_OCCURRENCE('id','${name}','',${outer},${inner},$)`);
    const shape = add(`PRODUCT_DEFINITION_SHAPE('','',${use})`);
    add(`CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(${relation},${shape})`);
  };
  const faces = [stepSquare(add, 0, "low", color), stepSquare(add, 2, "high")];
  const shell = add(`OPEN_SHELL('',(${faces}))`);
  const valve = product("in / out", add(`SHELL_BASED_SURFACE_MODEL('',(${shell}))`));
  const [pump, machine] = [product("pump", ""), product("machine", "")];
  for (const y of [0, 2]) place(valve, pump, y, "");
  place(pump, machine, 0, "");
  place(pump, machine, 10, "spare");
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
