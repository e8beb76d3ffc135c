import { HausdorffError } from "../../error.js";
import type { InterchangeCurve, InterchangeSurface } from "../../model/surface.js";
import type { SkippedFace } from "../report.js";
import {
  type BrepFace,
  type BrepTopology,
  type BrepTrim,
  boundsArea,
  brepTopology,
} from "./brep.js";
import { ChunkReader } from "./chunks.js";
import { part, pointAt, reversed } from "./curves/curve-operations.js";
import { type MappedCurve, mappedCurve } from "./curves/mapped-curve.js";
import { domain, type ParameterMaps, parameterMaps } from "./curves/parameter-map.js";
import { nurbsForm, nurbsOf } from "./surface.js";
import type { RhinoBrep, RhinoNurbsSurface, RhinoSurface } from "./types.js";

/** Faces read, with the counts for a report. */
export interface RhinoFaces {
  faces: InterchangeSurface[];
  trims: number;
  fitted: number;
  gap: number;
  skipped: SkippedFace[];
}

/** Points at which the deviation of an approximated curve is measured. */
const CHECKS = 16;
/** The factor by which the measured deviation is enlarged. */
const SAFETY = 2;

/** Classes whose NURBS form may run through the surface at another speed. */
const REPARAMETRIZED: Readonly<Record<string, string>> = {
  A16220D3163B11D480000010830122F0: "surface of revolution",
  C4CD5359446D46909FF529059732472B: "sum surface",
};

/**
 * The faces of a B-rep, with their trimming curves exactly as they are stored.
 * `name` begins the faces' names.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE` for a damaged B-rep.
 */
export function brepFaces(brep: RhinoBrep, name: string): RhinoFaces {
  const { data } = brep.encode() as { data?: unknown };
  if (typeof data !== "string") {
    throw new HausdorffError("CAD_UNREADABLE", `${name}: rhino3dm encodes no B-rep`);
  }
  const topology = brepTopology(ChunkReader.ofBase64(data));
  const read: RhinoFaces = { faces: [], trims: 0, fitted: 0, gap: 0, skipped: [] };
  const list = brep.faces();
  topology.faces.forEach((face, index) => {
    const part = `${name} face ${index}`;
    try {
      const converted = faceOf(topology, face, list.get(index).underlyingSurface(), part);
      read.faces.push(converted.face);
      read.trims += converted.trims;
      read.fitted += converted.fitted;
      read.gap = Math.max(read.gap, converted.gap);
    } catch (error) {
      if (!(error instanceof HausdorffError)) throw error;
      read.skipped.push({ face: part, code: error.code, why: error.message });
    }
  });
  return read;
}

/** A face's surface, and the maps from its own parameters to those of its NURBS form. */
interface FaceSurface {
  surface: RhinoSurface;
  nurbs: RhinoNurbsSurface;
  form: InterchangeSurface;
  maps: ParameterMaps;
}

interface FaceRead {
  face: InterchangeSurface;
  trims: number;
  fitted: number;
  gap: number;
}

function faceOf(
  topology: BrepTopology,
  face: BrepFace,
  surface: RhinoSurface | null,
  part: string,
): FaceRead {
  const on = faceSurface(surface, topology.surfaceClasses[face.surface] ?? "");
  const loops = pick(topology.loops, face.loops)
    .filter(boundsArea)
    .map(({ trims }) =>
      pick(topology.trims, trims).flatMap((trim) => curvesOf(topology, trim, on)),
    );
  const curves = loops.flat();
  const trim = loops.map((loop) => loop.map(({ curve }) => curve));
  const gap = curves.reduce((largest, { curve }) => Math.max(largest, curve.gap ?? 0), 0);
  const measured = gap > 0 ? { gap_measured: true } : {};
  return {
    face: { ...on.form, trim, reversed: face.reversed, part, ...measured },
    trims: curves.length,
    fitted: curves.filter(({ fitted }) => fitted).length,
    gap,
  };
}

function pick<T>(list: readonly T[], indices: readonly number[]): T[] {
  return indices.flatMap((index) => list.slice(index, index + 1));
}

function faceSurface(surface: RhinoSurface | null, uuid: string): FaceSurface {
  const nurbs = nurbsOf(surface);
  const form = nurbsForm(nurbs);
  const kind = REPARAMETRIZED[uuid];
  const maps =
    kind === undefined || surface === null
      ? ([null, null] as const)
      : parameterMaps(surface, nurbs, form);
  if (maps === null) {
    const why = `its ${kind} has other parameters as NURBS: export the model as STEP`;
    throw new HausdorffError("CAD_UNREADABLE", why);
  }
  return { surface: surface ?? nurbs, nurbs, form, maps };
}

function curvesOf(
  topology: BrepTopology,
  trim: BrepTrim,
  on: FaceSurface,
): { curve: InterchangeCurve; fitted: boolean }[] {
  const curve = topology.curves[trim.curve];
  if (curve === undefined) return [];
  const parts = part(curve, trim.domain);
  const run = trim.reversed ? parts.map(reversed).reverse() : parts;
  const [[u0, u1], [v0, v1]] = [domain(on.form, 0), domain(on.form, 1)];
  const mapped = run.flatMap((curve) => mappedCurve(curve, on.maps, Math.max(u1 - u0, v1 - v0)));
  // A tolerance that is not set is a negative number.
  const tolerance = Math.max(0, topology.edgeTolerances[trim.edge] ?? 0);
  return mapped.map((image) => {
    const gap = tolerance + deviation(image, on);
    const { degree, knots, controlPoints } = image.curve;
    const ctrl = controlPoints.map(
      (point) => [point[0] ?? 0, point[1] ?? 0, point.at(-1) ?? 1] as const,
    );
    const optional = {
      ...(gap > 0 ? { gap } : {}),
      ...(trim.edge >= 0 ? { edge: trim.edge } : {}),
    };
    return { curve: { degree, knots, ctrl, ...optional }, fitted: image.original !== null };
  });
}

/** The deviation in space of an approximated curve, from samples. */
function deviation({ curve, original }: MappedCurve, { surface, nurbs }: FaceSurface): number {
  if (original === null) return 0;
  const [start, end] = [curve.knots[0] ?? 0, curve.knots.at(-1) ?? 1];
  const distances = Array.from({ length: CHECKS }, (_, k) => {
    const t = start + ((k + 0.5) / CHECKS) * (end - start);
    const [[a = 0, b = 0], [c = 0, d = 0]] = [pointAt(curve, t), pointAt(original, t)];
    const [found, expected] = [nurbs.pointAt(a, b), surface.pointAt(c, d)];
    return Math.hypot(...found.map((x, axis) => x - (expected[axis] ?? 0)));
  });
  return SAFETY * Math.max(...distances);
}
