// What the page and its worker say to each other.
import type {
  DistanceOptions,
  DistanceResult,
  ErrorCode,
  ShapeInfo,
  Tessellation,
  Vector3,
} from "nurbs-hausdorff";

export type Side = "a" | "b";

/** Where a model comes from. */
export type Source = { shape: string } | { json: string; name: string };

/** Options that can be posted. */
export type PlainOptions = Omit<DistanceOptions, "signal" | "onProgress">;

export type Request =
  | { kind: "load"; side: Side; source: Source }
  | { kind: "measure"; run: number; options: PlainOptions }
  | { kind: "cancel" };

/** What there is to show of a model. */
export interface Shown {
  name: string;
  surfaceCount: number;
  box: { min: Vector3; max: Vector3 };
  tessellation: Tessellation;
}

export type Reply =
  | {
      kind: "ready";
      backend: "gpu" | "cpu";
      adapter: string | null;
      notice: string | null;
      shapes: ShapeInfo[];
    }
  | { kind: "loaded"; side: Side; shown: Shown }
  | { kind: "progress"; run: number; fraction: number; interval: [number, number] | undefined }
  | { kind: "measured"; run: number; result: DistanceResult }
  | { kind: "cancelled"; run: number }
  | {
      kind: "failed";
      about: Side | "measure" | "start";
      code: ErrorCode | "ERROR";
      message: string;
    };
