import { type CheckedArrays, checked, isArray, type SurfaceArrays } from "./arrays.js";
import { HausdorffError } from "./error.js";
import { type InterchangeModel, parse, read } from "./interchange.js";
import { PreparedModel, Surfaces } from "./wasm/nurbs_hausdorff.js";

/**
 * The module's model of what `Hausdorff.model` takes.
 * @internal
 */
export function prepare(
  input: readonly SurfaceArrays[] | InterchangeModel | string,
): PreparedModel {
  if (isArray(input)) return validated(undefined, (input as readonly SurfaceArrays[]).map(checked));
  if (typeof input !== "string" && (typeof input !== "object" || input === null)) {
    const found = `the model is ${input === null ? "null" : typeof input}`;
    const expected = "expected an array of surfaces, interchange JSON or its text";
    throw new HausdorffError("ARGUMENT_INVALID", `${found}, ${expected}`);
  }
  const { name, surfaces } = read(typeof input === "string" ? parse(input) : input);
  return validated(name, surfaces);
}

function validated(name: string | undefined, arrays: readonly CheckedArrays[]): PreparedModel {
  const surfaces = new Surfaces();
  for (const { degree, knotsU, knotsV, counts, controlPoints } of arrays) {
    surfaces.push(...degree, knotsU, knotsV, ...counts, controlPoints);
  }
  // Takes the surfaces over, and frees them.
  return PreparedModel.fromArrays(name, surfaces);
}
