// What the page and its worker say to each other.
import type {
  DistanceOptions,
  DistanceResult,
  ErrorCode,
  ShapeInfo,
  Tessellation,
  Transform,
  Vector3,
} from "nurbs-hausdorff";

export type Side = "a" | "b";

export const SIDES: readonly Side[] = ["a", "b"];

/** Something for each of the two models, or for one of them. */
export type Sides<T> = Partial<Record<Side, T>>;

/** Where a model comes from; of a file all surfaces, or the first. */
export type Source = { shape: string } | { file: File; firstSurface?: boolean };

/** Where model A is put when it is loaded. */
export interface Placement {
  /** In diagonals of the pair. */
  move: Vector3;
  /** Degrees about its vertical axis. */
  turn: number;
}

/** Options that can be posted. */
export type PlainOptions = Omit<DistanceOptions, "signal" | "onProgress">;

export type Request =
  | { kind: "load"; sources: Sides<Source>; placement: Placement }
  | { kind: "measure"; run: number; options: PlainOptions }
  | { kind: "cancel" };

/** What there is to show of a model. */
export interface Shown {
  source: Source;
  surfaceCount: number;
  box: { min: Vector3; max: Vector3 };
  tessellation: Tessellation;
  /** Vertices of the tessellation's open edges, two an edge. */
  outline: Uint32Array<ArrayBuffer>;
}

/** A code of the package's; `UNEXPECTED` is what it did not raise on purpose. */
export type Code = ErrorCode | "UNEXPECTED";

export type Reply =
  | {
      kind: "ready";
      backend: "gpu" | "cpu";
      adapter: string | null;
      notice: string | null;
      shapes: ShapeInfo[];
    }
  | { kind: "loaded"; models: Sides<Shown>; placement: Placement }
  | { kind: "progress"; run: number; fraction: number; interval: [number, number] | undefined }
  | { kind: "measured"; run: number; result: DistanceResult; transform: Transform }
  | { kind: "cancelled"; run: number }
  | { kind: "failed"; run?: number; code: Code; message: string };
