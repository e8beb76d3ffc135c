import { type ChunkReader, damaged } from "./chunks.js";
import { type Curve, curve } from "./curves/curve.js";

/** A trimming curve of an ON_Brep. */
export interface BrepTrim {
  /** Its index in the list of 2D curves. */
  curve: number;
  /** The part of that curve. */
  domain: [number, number];
  /** Whether the part is run backwards. */
  reversed: boolean;
  /** Its edge, or -1. */
  edge: number;
}

/** A loop of an ON_Brep: its trims in order, and its type. */
export interface BrepLoop {
  trims: number[];
  type: number;
}

/** A face of an ON_Brep. */
export interface BrepFace {
  loops: number[];
  surface: number;
  reversed: boolean;
}

/** What rhino3dm does not expose of a B-rep. */
export interface BrepTopology {
  curves: Curve[];
  /** The UUIDs of the surfaces' classes. */
  surfaceClasses: string[];
  /** The file's own tolerance of each edge; negative where it is not set. */
  edgeTolerances: number[];
  trims: BrepTrim[];
  loops: BrepLoop[];
  faces: BrepFace[];
}

/** Loops that bound area. The other types are slits, curves and points on the surface. */
const OUTER = 1;
const INNER = 2;

/** Whether a loop bounds area. */
export function boundsArea({ type }: BrepLoop): boolean {
  return type === OUTER || type === INNER;
}

/** The major version of an ON_Brep's data. */
const BREP_VERSION = 3;
/** Bytes of a trim after its flags, of a whole trim, and of the shortest other record. */
const TRIM_REST = 2 * 8;
const TRIM_LENGTH = 132;
const MIN_RECORD_LENGTH = 16;

/**
 * The trimming curves and the topology of an ON_Brep, from the archive chunk
 * that `Brep.encode()` writes.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE`.
 */
export function brepTopology(archive: ChunkReader): BrepTopology {
  const { data } = archive.object();
  data.version(BREP_VERSION);
  const curves = objects(data.anonymous(), (chunk) => curve(chunk.object()));
  // The edges' curves: the faces do not depend on them.
  data.anonymous();
  const surfaceClasses = objects(data.anonymous(), (chunk) => chunk.object().uuid);
  // The vertices.
  data.anonymous();
  const edgeTolerances = records(data.anonymous(), MIN_RECORD_LENGTH, edgeTolerance);
  const trims = records(data.anonymous(), TRIM_LENGTH, trim);
  const loops = records(data.anonymous(), MIN_RECORD_LENGTH, loop);
  const faces = records(data.anonymous(), MIN_RECORD_LENGTH, face);
  const topology = { curves, surfaceClasses, edgeTolerances, trims, loops, faces };
  checkIndices(topology);
  return topology;
}

function objects<T>(chunk: ChunkReader, read: (chunk: ChunkReader) => T): T[] {
  return records(chunk, 4, () => {
    if (chunk.int32() === 0) throw damaged("a curve or a surface is missing");
    return read(chunk);
  });
}

function records<T>(chunk: ChunkReader, length: number, read: (chunk: ChunkReader) => T): T[] {
  return Array.from({ length: chunk.count(length) }, () => read(chunk));
}

function edgeTolerance(chunk: ChunkReader): number {
  // Index, curve, direction, domain, vertices.
  chunk.skip(3 * 4 + 2 * 8 + 2 * 4);
  chunk.intList();
  const tolerance = chunk.float64();
  // The domain as an edge.
  chunk.skip(2 * 8);
  return tolerance;
}

function trim(chunk: ChunkReader): BrepTrim {
  const [, curve = -1] = chunk.ints(2);
  const domain: [number, number] = [chunk.float64(), chunk.float64()];
  // Edge, two vertices, direction on the edge, type, isoparametric side, loop.
  const [edge = -1] = chunk.ints(7);
  // Tolerances, domain as a trim.
  chunk.skip(2 * 8 + 2 * 8);
  const reversed = chunk.uint8() === 1;
  chunk.skip(7 + 24 + TRIM_REST);
  return { curve, domain, reversed, edge };
}

function loop(chunk: ChunkReader): BrepLoop {
  chunk.int32();
  const trims = chunk.intList();
  const [type = 0] = chunk.ints(2);
  return { trims, type };
}

function face(chunk: ChunkReader): BrepFace {
  chunk.int32();
  const loops = chunk.intList();
  const [surface = -1, reversed = 0] = chunk.ints(3);
  return { loops, surface, reversed: reversed !== 0 };
}

function checkIndices({ curves, surfaceClasses, trims, loops, faces }: BrepTopology): void {
  const within = (index: number, list: readonly unknown[], what: string) => {
    if (index < 0 || index >= list.length) throw damaged(`there is no ${what} ${index}`);
  };
  for (const { curve } of trims) within(curve, curves, "trimming curve");
  for (const loop of loops) for (const index of loop.trims) within(index, trims, "trim");
  for (const face of faces) {
    within(face.surface, surfaceClasses, "surface");
    for (const index of face.loops) within(index, loops, "loop");
  }
}
