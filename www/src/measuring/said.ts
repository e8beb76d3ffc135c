// What is said of a measurement.
import type { Vector3 } from "three";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";
import type { DisplayModel } from "../worker/protocol.ts";
import { minus, type Vector } from "./fit/linear.ts";
import type { Place } from "./measures.ts";

/** What is said of a measurement, and the arrow that shows it, in the scene. */
export interface Value {
  text: string;
  label: string;
  from: Vector3;
  to: Vector3;
  /** Which faces it is of. */
  of: string;
}

/** The unit in which lengths are shown. */
export const unitText = (): string => commonUnit() ?? texts.measuring.modelUnits;

/** What stands between two things that are said. */
export const SEPARATOR = " · ";

/** A place in its tessellation's coordinates. */
export const localOf = (model: DisplayModel, place: Place): Vector =>
  minus(place.point, model.tessellation.origin);

/** A face by its model and its name. */
export const nameOf = (model: DisplayModel, { side, face }: Place): string =>
  `${side.toUpperCase()} ${model.faceNames[face] ?? face}`;
