// How the models are shown, and what is drawn beside them.
import type { Vector3 as Point } from "nurbs-hausdorff";
import type { Wiped } from "../../controls/display.ts";
import type { Side } from "../../worker/protocol.ts";
import type { GizmoMode } from "../gizmo.ts";
import type { Visibility } from "../mesh.ts";
import type { ArrowTexts } from "../overlays/arrow.ts";
import type { Section } from "../section.ts";

/** What is drawn in addition to the models. */
export interface Overlays {
  deviation: boolean;
  lines: boolean;
  triangles: boolean;
}

/** An arrow between two points of a result, or a mark where both are the same. */
export interface ShownArrow {
  from: Point;
  to: Point;
  texts: ArrowTexts;
}

/** How the models are shown. */
export interface Display {
  visibility: Record<Side, Visibility>;
  orthographic: boolean;
  section: Section | undefined;
  gizmo: GizmoMode;
  /** Where A is shown only, and where B is. */
  wipe: Wiped | undefined;
  /** Whether what is not painted has the colours of its file. */
  fileColors: boolean;
  /** How far bodies are moved apart: from 0, where they stand, to 1. */
  exploded: number;
}
