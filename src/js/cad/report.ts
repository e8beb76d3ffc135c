import type { CadKind } from "./kind.js";

/** The reader of a file: the package's own, OpenCASCADE or rhino3dm. */
export type CadReader = "built-in" | "occt" | "rhino3dm";

/** A face that was not read, and the reason. */
export interface SkippedFace {
  /** The face's number in its file, or its name in a file of several shapes. */
  face: number | string;
  /** The number by which the file calls the face, as `#` in STEP, where it has one. */
  entity?: number;
  /** The stable code of the reason. */
  code: string;
  /** The reason in words. */
  why: string;
}

/** A face that the file does not define fully, and what was decided. */
export interface FaceNote {
  /** The face's number in its file, or its name in a file of several shapes. */
  face: number | string;
  /** The stable code of the remark. */
  code: string;
  /** The decision and its reason in words. */
  why: string;
}

/** What reading a CAD file, a mesh or points kept, changed and left out. */
export interface CadReport {
  /** The kind of file, found by its content; `mesh` for those that `readMesh` reads. */
  kind: CadKind | "mesh";
  /** The reader that took it. */
  reader: CadReader;
  /** Number of faces read, instances not counted. */
  faces: number;
  /** Number of trimming curves. */
  trims: number;
  /** Number of trimming curves converted without approximation. */
  exact: number;
  /** Number of trimming curves approximated; `gap` contains their deviation too. */
  fitted: number;
  /**
   * The distance between a trimming curve on its surface and the edge that it stands for, in
   * model units: an ambiguity of the file itself.
   */
  gap: number;
  /** Whether the gap is an upper bound; docs/cad.md lists what is measured at points instead. */
  gapProven: boolean;
  /** Metres per model unit; null where neither the file nor the caller states it. */
  unit: number | null;
  /** The faces left out. */
  skipped: SkippedFace[];
  /**
   * The faces that the file leaves ambiguous, as those on a closed surface whose
   * complement has the same edges.
   */
  notes: FaceNote[];
}
