import { HausdorffError } from "../../error.js";
import type { InterchangeCurve, InterchangeFace } from "../interchange.js";
import type { SkippedFace } from "../report.js";
import {
  type BrepFace,
  type BrepTopology,
  type BrepTrim,
  boundsArea,
  brepTopology,
} from "./brep.js";
import { ChunkReader } from "./chunks.js";
import type { NurbsCurve } from "./curve.js";
import { part, reversed } from "./curve-operations.js";
import { nurbsForm } from "./surface.js";
import type { RhinoBrep, RhinoFace, RhinoSurface } from "./types.js";

/** Faces read, with the counts for a report. */
export interface RhinoFaces {
  faces: InterchangeFace[];
  trims: number;
  gap: number;
  skipped: SkippedFace[];
}

/** Classes whose NURBS form may run through the surface at another speed. */
const REPARAMETRIZED: Readonly<Record<string, string>> = {
  A16220D3163B11D480000010830122F0: "surface of revolution",
  C4CD5359446D46909FF529059732472B: "sum surface",
};

/** Parameters, as fractions of the domain, at which two forms of a surface are compared. */
const PROBES = [0.1, 0.37, 0.61, 0.93];
/** The relative deviation up to which they count as one. */
const SAME = 1e-9;

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
  const read: RhinoFaces = { faces: [], trims: 0, gap: 0, skipped: [] };
  const list = brep.faces();
  topology.faces.forEach((face, index) => {
    const part = `${name} face ${index}`;
    try {
      const converted = faceOf(topology, face, list.get(index), part);
      read.faces.push(converted.face);
      read.trims += converted.trims;
      read.gap = Math.max(read.gap, converted.gap);
    } catch (error) {
      if (!(error instanceof HausdorffError)) throw error;
      read.skipped.push({ face: part, why: error.message });
    }
  });
  return read;
}

function faceOf(
  topology: BrepTopology,
  face: BrepFace,
  rhino: RhinoFace,
  part: string,
): { face: InterchangeFace; trims: number; gap: number } {
  const surface = rhino.underlyingSurface();
  const form = nurbsForm(surface);
  requireSameParameters(topology.surfaceClasses[face.surface] ?? "", surface, form);
  const loops = face.loops
    .map((index) => topology.loops[index])
    .filter((loop) => loop !== undefined)
    .filter(boundsArea)
    .map((loop) =>
      loop.trims
        .map((index) => topology.trims[index])
        .filter((trim) => trim !== undefined)
        .flatMap((trim) => curvesOf(topology, trim)),
    );
  const curves = loops.flat();
  return {
    face: { ...form, trim: loops, reversed: face.reversed, part },
    trims: curves.length,
    gap: Math.max(0, ...curves.map(({ gap = 0 }) => gap)),
  };
}

function curvesOf(topology: BrepTopology, trim: BrepTrim): InterchangeCurve[] {
  const curve = topology.curves[trim.curve];
  if (curve === undefined) return [];
  const parts = part(curve, trim.domain);
  const run = trim.reversed ? parts.map(reversed).reverse() : parts;
  const tolerance = topology.edgeTolerances[trim.edge] ?? 0;
  return run.map(({ degree, knots, controlPoints }: NurbsCurve) => ({
    degree,
    knots,
    ctrl: controlPoints.map((point) => [point[0] ?? 0, point[1] ?? 0, point.at(-1) ?? 1] as const),
    // A tolerance that is not set is a negative number.
    ...(tolerance > 0 ? { gap: tolerance } : {}),
    ...(trim.edge >= 0 ? { edge: trim.edge } : {}),
  }));
}

function requireSameParameters(
  uuid: string,
  surface: RhinoSurface | null,
  form: ReturnType<typeof nurbsForm>,
): void {
  const kind = REPARAMETRIZED[uuid];
  if (kind === undefined || surface === null) return;
  const nurbs = surface.toNurbsSurface();
  if (nurbs === null) return;
  const [u, v] = [form.knots_u, form.knots_v].map((knots) => [knots[1] ?? 0, knots.at(-2) ?? 1]);
  const [[u0 = 0, u1 = 1] = [], [v0 = 0, v1 = 1] = []] = [u, v];
  for (const a of PROBES) {
    for (const b of PROBES) {
      const at = [u0 + a * (u1 - u0), v0 + b * (v1 - v0)] as const;
      const [found, expected] = [nurbs.pointAt(...at), surface.pointAt(...at)];
      const size = Math.hypot(...expected) + 1;
      if (Math.hypot(...found.map((x, i) => x - (expected[i] ?? 0))) > SAME * size) {
        throw new HausdorffError(
          "CAD_UNREADABLE",
          `its ${kind} has other parameters as NURBS; export it as STEP`,
        );
      }
    }
  }
}
