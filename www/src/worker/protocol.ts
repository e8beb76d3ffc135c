// The messages between the page and its worker.
import type {
  BestFit,
  BestFitOptions,
  Body,
  CheckOptions,
  CheckResult,
  ClearanceResult,
  DiffOptions,
  DiffResult,
  DistanceOptions,
  DistanceResult,
  ErrorCode,
  FaceForm,
  Facts,
  GapOptions,
  GapsResult,
  OverlapOptions,
  OverlapResult,
  PartDifference,
  ShapeInfo,
  Tessellation,
  Transform,
  Vector3,
} from "nurbs-hausdorff";
import type { CadReport } from "nurbs-hausdorff/cad";
import type { Bounds } from "../common/bounds.ts";
import type { MapDisplay } from "./map/display.ts";

export type Side = "a" | "b";

export const SIDES: readonly Side[] = ["a", "b"];

/** A value for each of the two models, or for one of them. */
export type Sides<T> = Partial<Record<Side, T>>;

/**
 * The source of a model: a shape's name, or a file, with all surfaces or only the first, and the metres
 * in the unit of one that states none.
 */
export type Source = { shape: string } | { file: File; firstSurface?: boolean; unit?: number };

/** The initial position of model A. */
export interface Placement {
  /** The translation, in units of the larger of the two boxes' diagonals. */
  move: Vector3;
  /** The rotation about A's vertical axis, in degrees. */
  turn: number;
}

/** What of options of each method can be posted to a worker. */
export type Plain<Options> = Options extends unknown
  ? Omit<Options, "signal" | "onProgress">
  : never;

/** The options that can be posted to a worker. */
export type PlainOptions = Plain<DistanceOptions>;

/** The options of a comparison face by face that can be posted to a worker. */
export type PlainDiffOptions = Omit<DiffOptions, "signal" | "onProgress"> & {
  /** The limits of faces that have their own. */
  own?: readonly { side: Side; face: number; limit: number }[];
};

/** The options of a best fit that can be posted to a worker. */
export type PlainFitOptions = Omit<BestFitOptions, "signal" | "onProgress">;

/** The options of a clearance and its gaps that can be posted to a worker. */
export type PlainGapOptions = Omit<GapOptions, "signal" | "onProgress">;

/** The options of volumes in common that can be posted to a worker. */
export type PlainOverlapOptions = Omit<OverlapOptions, "signal" | "onProgress">;

/** The options of a check that can be posted to a worker. */
export type PlainCheckOptions = Omit<CheckOptions, "signal" | "onProgress" | "names">;

/** The bodies that a check is of: those of one model, or of both as one assembly. */
export type CheckOf = Side | "both";

/** A point of one model, and its closest point on the other. */
export interface Probe {
  side: Side;
  /** The name of its face; of a mesh its triangle, of a scan its point. */
  face: string;
  /** Its parameters on its face; a mesh has none. */
  u?: number;
  v?: number;
  point: Vector3;
  foot: Vector3;
  /** That of the foot on the other model. */
  footFace: string;
  distance: number;
  /** The true distance differs from `distance` by at most this. */
  bound: number;
  /** The distance with a sign; NaN without one. */
  signed: number;
}

export type Request =
  | { kind: "load"; sources: Sides<Source>; placement: Placement }
  /** Loads models that are drawn already, which a worker before this one had. */
  | { kind: "restore"; sources: Sides<Source> }
  /** `paint` names the models whose deviations are mapped. */
  | { kind: "measure"; run: number; options: PlainOptions; paint: readonly Side[] }
  | { kind: "cancel" }
  | { kind: "diff"; options: PlainDiffOptions }
  | { kind: "cancelDiff" }
  /** Asks what is certain of each face of the result of a run. */
  | { kind: "bound"; run: number; options: PlainDiffOptions }
  | { kind: "cancelBound" }
  | { kind: "fit"; options: PlainFitOptions }
  | { kind: "cancelFit" }
  | { kind: "clearance"; options: PlainGapOptions }
  | { kind: "cancelClearance" }
  /** Asks for the faces of each body. */
  | { kind: "bodies" }
  /** Asks for the facts of the models and of their bodies. */
  | { kind: "facts" }
  | { kind: "overlap"; options: PlainOverlapOptions }
  | { kind: "cancelOverlap" }
  /** `transform` moves A where both are checked as one assembly. */
  | { kind: "check"; of: CheckOf; options: PlainCheckOptions; transform?: Transform }
  | { kind: "cancelCheck" }
  /** `near` is in the model's own coordinates; `scale` is A's units in one of B's. */
  | { kind: "probe"; id: number; side: Side; near: Vector3; transform: Transform; scale: number }
  | { kind: "csv" };

/** Edges of a tessellation: two vertices each, and for every face the end of its edges. */
export interface Outline {
  edges: Uint32Array<ArrayBuffer>;
  ends: number[];
}

/** Faces of a file that is being read: their edges, and triangles of those that are cut already. */
export interface Draft {
  /** About which part of reading is done. */
  fraction: number;
  /** The point that coordinates are relative to. */
  origin: Vector3;
  /** Two ends a segment. */
  edges: Float32Array<ArrayBuffer>;
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
}

/** What the page needs to draw a model. */
export interface DisplayModel {
  source: Source;
  faceCount: number;
  /** Metres per unit; null where it is unknown. */
  unit: number | null;
  /** What reading a file kept, changed and left out; null for a shape. */
  report: CadReport | null;
  box: { min: Vector3; max: Vector3 };
  tessellation: Tessellation;
  /** The box of its vertices, relative to its origin. */
  bounds: Bounds;
  /** The edges of its faces. */
  outline: Outline;
  /** Whether its triangles are the model itself, flat each. */
  isMesh: boolean;
  /** The names of its faces in their source. */
  faceNames: string[];
  /** The colours of its faces in their source, in sRGB from 0 to 1; empty if it gives none. */
  faceColors: (Vector3 | null)[];
  /** The elementary surfaces that its faces lie on, null for others; of a mesh none at all. */
  faceForms: (FaceForm | null)[];
}

/** An error code of the package, or `UNEXPECTED` for any other exception. */
export type Code = ErrorCode | "UNEXPECTED";

/** The backend of the engine, which changes when a device is lost. */
export interface EngineState {
  backend: "gpu" | "cpu";
  adapter: string | null;
  /** The reason why there is no GPU. */
  notice: string | null;
}

/** How a task ends that has no result. */
export type Ended = { state: "cancelled" } | { state: "failed"; code: Code; message: string };

/** The state of the comparison face by face. */
export type DiffState =
  | { state: "working"; fraction: number }
  /** `parts` has more than one part, or none. */
  | { state: "done"; result: DiffResult; parts: PlacedPart[] };

/** What became of a part, with the faces that it has in A and in B. */
export type PlacedPart = PartDifference & { facesOf: Record<Side, number[]> };

/** The state of the best fit. */
export type FitState =
  | { state: "working"; step: number; rms: number; fraction: number }
  | { state: "done"; fit: BestFit };

/** The state of a clearance; `gaps` where faces come nearer than asked for. */
export type ClearanceState = {
  state: "done";
  clearance: ClearanceResult;
  gaps: GapsResult | undefined;
};

/** What is certain of a model and of its bodies, in the units of its own file. */
export interface ModelFacts {
  facts: Facts;
  bodies: Body[];
}

export type FactsState = { state: "done"; models: Sides<ModelFacts> };

export type OverlapState =
  | { state: "working"; fraction: number }
  | { state: "done"; result: OverlapResult };

/** The model and the faces of a body, in the order of `CheckResult.bodies`. */
export interface CheckedFaces {
  side: Side;
  faces: number[];
}

export type CheckState =
  | { state: "working"; fraction: number }
  | { state: "done"; of: CheckOf; result: CheckResult; bodies: CheckedFaces[] };

export type FactsReply = { kind: "facts" } & (FactsState | Ended);
export type OverlapReply = { kind: "overlap" } & (OverlapState | Ended);
export type CheckReply = { kind: "check" } & (CheckState | Ended);
export type ClearanceReply = { kind: "clearance" } & (ClearanceState | Ended);
export type BoundReply = {
  kind: "bound";
  run: number;
} /** `maps` are those that were more than is certain of a face, and are no longer. */ & (
  | { state: "done"; result: DiffResult; maps: Sides<MapDisplay> }
  | Ended
);
export type DiffReply = { kind: "diff" } & (DiffState | Ended);
export type FitReply = { kind: "fit" } & (FitState | Ended);

export type Reply =
  | FactsReply
  | OverlapReply
  | CheckReply
  | ClearanceReply
  | DiffReply
  | FitReply
  | BoundReply
  /** The faces of each body of the models. */
  | { kind: "bodies"; faces: Sides<number[][]> }
  | { kind: "ready"; engine: EngineState; shapes: ShapeInfo[] }
  /** A library is fetched that a file needs. */
  | { kind: "loading"; text: string }
  /** Faces of a side's file; of the sides `replaced` the models before are no longer of interest. */
  | { kind: "draft"; side: Side; replaced: Side[]; draft: Draft }
  | { kind: "loaded"; models: Sides<DisplayModel>; placement: Placement }
  /** The models drawn can be measured again. */
  | { kind: "restored" }
  /** The faces of the side's model close, so that a cut through it has a face. */
  | { kind: "closed"; side: Side }
  | {
      kind: "progress";
      run: number;
      fraction: number;
      interval: [number, number] | undefined;
      stalled: boolean;
    }
  | {
      kind: "measured";
      run: number;
      result: DistanceResult;
      maps: Sides<MapDisplay>;
      /** Whether the same result follows with colours, or with finer ones. */
      pending: boolean;
      /** The transform of A with which the result was computed. */
      transform: Transform;
      engine: EngineState;
    }
  | { kind: "probed"; id: number; probe: Probe | undefined }
  | { kind: "csv"; table: Blob }
  /** `interval` is what the search had reached, if it had. */
  | { kind: "cancelled"; run: number; interval: readonly [number, number] | undefined }
  | { kind: "failed"; run?: number; code: Code; message: string };
