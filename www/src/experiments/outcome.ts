// What a sweep gives.
import type { DistanceResult } from "nurbs-hausdorff";
import type { Code } from "../protocol.ts";
import type { Entry } from "./methods.ts";

/** Why there is no result: an error of the package, or the page's own reason. */
export interface Failure {
  /** `left-out`: not affordable, not begun; `time-limit`: ended by the limit of the panel. */
  code: Code | "left-out" | "time-limit";
  message: string;
}

/** What one method gave at one position. */
export type Outcome = { position: number } & (
  | { result: DistanceResult; failure?: never }
  | { result?: never; failure: Failure }
);

/** A method's outcomes in the order of the positions, as far as the sweep has come. */
export interface Curve {
  method: Entry;
  outcomes: Outcome[];
}
