import type { ArchiveObject, ChunkReader } from "../chunks.js";
import { damaged } from "../chunks.js";

/** A rational B-spline curve: control points are Euclidean coordinates, then the weight. */
export interface NurbsCurve {
  degree: number;
  /** `controlPoints.length + degree + 1` of them. */
  knots: number[];
  controlPoints: number[][];
}

/** A curve and the parameters of its ends. */
export interface Curve {
  domain: [number, number];
  /** The pieces in order; each is the curve over its own part of the domain. */
  pieces: CurvePiece[];
}

/** A NURBS curve that runs over a part of a curve's domain, in proportion but for arcs. */
export interface CurvePiece {
  domain: [number, number];
  nurbs: NurbsCurve;
  /** The parameter of the NURBS curve at a parameter of the curve. */
  parameter: (t: number) => number;
}

/** Numbers of coordinates that trimming curves and edges have. */
const MAX_DIMENSION = 3;
/** openNURBS' bound on degrees is far below; a larger one is damage. */
const MAX_ORDER = 64;
/** A limit on nested polycurves, against damage that nests without end. */
const MAX_DEPTH = 16;

const READERS: Readonly<Record<string, (data: ChunkReader, depth: number) => Curve>> = {
  "4ED7D4DDE94711D3BFE50010830122F0": nurbsCurve,
  "4ED7D4DBE94711D3BFE50010830122F0": lineCurve,
  "4ED7D4E6E94711D3BFE50010830122F0": polylineCurve,
  "4ED7D4E0E94711D3BFE50010830122F0": polyCurve,
  CF33BE2A09B411D4BFFB0010830122F0: arcCurve,
};

/**
 * The curve of an archive object.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE` for damage and unknown classes.
 */
export function curve(object: ArchiveObject, depth = 0): Curve {
  const read = READERS[object.uuid];
  if (read === undefined) throw damaged(`it has a curve of the class ${object.uuid}`);
  if (depth > MAX_DEPTH) throw damaged("its curves are nested too deep");
  return read(object.data, depth);
}

function single(nurbs: NurbsCurve, domain: [number, number]): Curve {
  const [start, end] = nurbsDomain(nurbs);
  const scale = (end - start) / (domain[1] - domain[0]);
  const parameter = (t: number) =>
    t === domain[1]
      ? end
      : start + (t - domain[0]) * (start === domain[0] && end === domain[1] ? 1 : scale);
  return { domain, pieces: [{ domain, nurbs, parameter }] };
}

function nurbsDomain({ degree, knots, controlPoints }: NurbsCurve): [number, number] {
  return [knots[degree] ?? 0, knots[controlPoints.length] ?? 1];
}

function nurbsCurve(data: ChunkReader): Curve {
  data.version();
  const [dimension = 0, rational = 0, order = 0, count = 0] = data.ints(4);
  if (
    dimension < 2 ||
    dimension > MAX_DIMENSION ||
    order < 2 ||
    order > MAX_ORDER ||
    count < order
  ) {
    throw damaged(`a curve of ${count} points has the order ${order} and ${dimension} coordinates`);
  }
  // Two reserved integers and a box that is not kept up to date.
  data.skip(2 * 4 + 6 * 8);
  const knots = data.doubleList();
  if (knots.length !== order + count - 2) throw damaged(`a curve has ${knots.length} knots`);
  const stride = dimension + (rational ? 1 : 0);
  if (data.count(stride * 8) !== count) throw damaged("a curve lacks control points");
  const controlPoints = Array.from({ length: count }, () => {
    const values = data.doubles(stride);
    const weight = rational ? (values[dimension] ?? 1) : 1;
    // openNURBS stores coordinates multiplied by the weight.
    return [...values.slice(0, dimension).map((value) => value / weight), weight];
  });
  const nurbs = { degree: order - 1, knots: withEndKnots(knots), controlPoints };
  return single(nurbs, nurbsDomain(nurbs));
}

/** openNURBS omits the first and the last knot, on which no basis function depends. */
export function withEndKnots(knots: readonly number[]): number[] {
  return [knots[0] ?? 0, ...knots, knots.at(-1) ?? 1];
}

function line(from: number[], to: number[], domain: [number, number]): Curve {
  const [start, end] = domain;
  const nurbs = {
    degree: 1,
    knots: [start, start, end, end],
    controlPoints: [
      [...from, 1],
      [...to, 1],
    ],
  };
  return single(nurbs, domain);
}

function lineCurve(data: ChunkReader): Curve {
  data.version();
  const [from, to, domain] = [data.doubles(3), data.doubles(3), interval(data)];
  const dimension = data.int32();
  return line(from.slice(0, dimension), to.slice(0, dimension), domain);
}

function interval(data: ChunkReader): [number, number] {
  const [start, end] = [data.float64(), data.float64()];
  if (!(start < end)) throw damaged(`a curve has the domain [${start}, ${end}]`);
  return [start, end];
}

function polylineCurve(data: ChunkReader): Curve {
  data.version();
  const points = Array.from({ length: data.count(24) }, () => data.doubles(3));
  const parameters = data.doubleList();
  const dimension = data.int32();
  if (points.length < 2 || parameters.length !== points.length) {
    throw damaged(`a polyline has ${points.length} points and ${parameters.length} parameters`);
  }
  const [start = 0, end = 1] = [parameters[0], parameters.at(-1)];
  const nurbs = {
    degree: 1,
    knots: withEndKnots(parameters),
    controlPoints: points.map((point) => [...point.slice(0, dimension), 1]),
  };
  return single(nurbs, [start, end]);
}

function polyCurve(data: ChunkReader, depth: number): Curve {
  data.version();
  const count = data.int32();
  data.skip(2 * 4 + 6 * 8);
  const ends = data.doubleList();
  if (ends.length !== count + 1) throw damaged("a polycurve lacks parameters");
  const pieces: CurvePiece[] = [];
  for (let index = 0; index < count; index += 1) {
    const segment = curve(data.object(), depth + 1);
    const domain: [number, number] = [ends[index] ?? 0, ends[index + 1] ?? 1];
    pieces.push(...segment.pieces.map((piece) => stretched(piece, segment.domain, domain)));
  }
  return { domain: [ends[0] ?? 0, ends.at(-1) ?? 1], pieces };
}

/** The piece over the interval that an affine map of `from` to `to` makes of its own. */
function stretched(piece: CurvePiece, from: [number, number], to: [number, number]): CurvePiece {
  const map = (t: number, [a, b]: [number, number], [c, d]: [number, number]) =>
    t === a ? c : t === b ? d : c + ((t - a) * (d - c)) / (b - a);
  const [start, end] = piece.domain;
  return {
    domain: [map(start, from, to), map(end, from, to)],
    nurbs: piece.nurbs,
    parameter: (t) => piece.parameter(map(t, to, from)),
  };
}

/** The largest angle of one rational quadratic piece of an arc. */
const MAX_ARC_ANGLE = Math.PI / 2;

function arcCurve(data: ChunkReader): Curve {
  data.version();
  const [centre, x, y] = [data.doubles(3), data.doubles(3), data.doubles(3)];
  // The plane's normal and equation.
  data.skip(3 * 8 + 4 * 8);
  const radius = data.float64();
  // Three points of the circle, of older versions.
  data.skip(9 * 8);
  const [from, to] = interval(data);
  const domain = interval(data);
  const dimension = data.int32();
  const count = Math.ceil((to - from) / MAX_ARC_ANGLE - 1e-12);
  const at = (angle: number, scale = 1) =>
    centre
      .map(
        (c, i) =>
          c + radius * scale * (Math.cos(angle) * (x[i] ?? 0) + Math.sin(angle) * (y[i] ?? 0)),
      )
      .slice(0, dimension);
  const pieces = Array.from({ length: count }, (_, index): CurvePiece => {
    const [a, b] = [index, index + 1].map((k) => from + ((to - from) * k) / count) as [
      number,
      number,
    ];
    const [start, end] = [index, index + 1].map(
      (k) => domain[0] + ((domain[1] - domain[0]) * k) / count,
    ) as [number, number];
    const half = (b - a) / 2;
    const weight = Math.cos(half);
    const middle = (a + b) / 2;
    const nurbs = {
      degree: 2,
      knots: [0, 0, 0, 1, 1, 1],
      controlPoints: [
        [...at(a), 1],
        [...at(middle, 1 / weight), weight],
        [...at(b), 1],
      ],
    };
    // The angle from the middle is 2 atan(s tan(half / 2)) at s in [-1, 1].
    const parameter = (t: number) => {
      if (t === start) return 0;
      if (t === end) return 1;
      const angle = ((t - start) / (end - start)) * 2 * half - half;
      return (1 + Math.tan(angle / 2) / Math.tan(half / 2)) / 2;
    };
    return { domain: [start, end], nurbs, parameter };
  });
  return { domain, pieces };
}
