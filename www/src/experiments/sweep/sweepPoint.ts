// The results of a sweep.
import type { DistanceResult } from "nurbs-hausdorff";
import type { Code } from "../../worker/protocol.ts";
import type { Entry } from "./methods.ts";

/** The reason why there is no result: an error of the package, or a limit of the page. */
export interface Failure {
  /** `left-out`: too expensive to start; `time-limit`: cancelled at the form's time limit. */
  code: Code | "left-out" | "time-limit";
  message: string;
}

/** The result or failure of one method at one position. */
export type SweepPoint = { position: number } & (
  | { result: DistanceResult; failure?: never }
  | { result?: never; failure: Failure }
);

/** The points of one method so far, in the order of the positions. */
export interface Curve {
  method: Entry;
  points: SweepPoint[];
}
