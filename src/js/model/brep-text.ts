import { prepareBrep } from "../cad/prepare/brep.js";
import { HausdorffError, translating } from "../error.js";
import { NurbsModel } from "./model.js";
import type { BrepText } from "./surface.js";

/** Whether the input of `Hausdorff.model` is BREP text. */
export function isBrepText(input: unknown): input is BrepText {
  return typeof input === "object" && input !== null && "brep" in input;
}

/** The model of BREP text, with the report on reading it. */
export function fromBrepText({ brep, unit }: BrepText): NurbsModel {
  requireType("brep", brep, "string");
  if (unit !== undefined) requireType("unit", unit, "number");
  const file = {
    kind: "brep",
    brep,
    declared: 0,
    ...(unit === undefined ? {} : { unit }),
  } as const;
  return translating(() => {
    const { prepared, report } = prepareBrep(file, undefined);
    return NurbsModel.of(prepared, report);
  });
}

function requireType(name: string, value: unknown, type: "string" | "number"): void {
  if (typeof value === type) return;
  throw new HausdorffError("ARGUMENT_INVALID", `${name} is ${typeof value}, expected a ${type}`);
}
