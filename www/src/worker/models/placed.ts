// A model where the user moved it: read again, as instances by its motion, for what takes no motion.

import type { InterchangeModel, Transform } from "nurbs-hausdorff";
import { convertCad, meshFormatOf } from "nurbs-hausdorff/cad";
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff/worker";
import { example } from "../../examples/index.ts";
import { texts } from "../../texts/index.ts";
import type { Source } from "../protocol.ts";
import { moved } from "../rigid.ts";

/** The matrix of one that stands where it is. */
const IN_PLACE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] as const;

/**
 * Returns the model of a source, moved. Its faces are numbered as those of the model itself. Coordinates
 * are rounded to float64 once more, far below what a check tells apart.
 *
 * @throws {HausdorffError} `OPTION_INVALID` for meshes, points and named shapes, which have no instances.
 */
export async function placedModel(
  engine: Hausdorff,
  source: Source,
  transform: Transform,
): Promise<NurbsModel> {
  const model = await interchangeOf(source);
  const motion = matrixOf(transform);
  const all = model.surfaces.map((_, index) => index);
  const own = model.instances ?? [];
  const instances = own.length === 0 ? [{ surfaces: all, transform: IN_PLACE }] : own;
  return engine.model({
    ...model,
    instances: instances.map((instance) => ({
      ...instance,
      transform: product(motion, instance.transform),
    })),
  });
}

async function interchangeOf(source: Source): Promise<InterchangeModel> {
  if ("shape" in source) {
    const own = example(source.shape);
    if (own !== undefined) return own;
    throw notPlaced(source.shape);
  }
  const { file, unit } = source;
  const name = file.name.replace(/\.gz$/i, "");
  if (meshFormatOf(name) !== undefined || source.firstSurface) throw notPlaced(file.name);
  const { json } = await convertCad(await file.arrayBuffer(), {
    ...{ name: file.name, ...(unit !== undefined && { unit }) },
  });
  return JSON.parse(json) as InterchangeModel;
}

const notPlaced = (name: string): HausdorffError =>
  new HausdorffError("OPTION_INVALID", texts.files.movedMeshNotChecked(name));

/** A motion as a row-major 3x4 matrix: its columns are where the axes go to. */
function matrixOf(transform: Transform): number[] {
  const { rotation } = transform;
  const turn = rotation === undefined ? {} : { rotation };
  const [x, y, z] = [
    moved([1, 0, 0], turn),
    moved([0, 1, 0], turn),
    moved([0, 0, 1], turn),
  ] as const;
  const way = moved([0, 0, 0], transform);
  return [0, 1, 2].flatMap((row) => [x, y, z, way].map((column) => column[row] ?? 0));
}

/** The row-major 3x4 matrix of the second one first, and then the first one. */
function product(after: readonly number[], before: readonly number[]): number[] {
  const at = (matrix: readonly number[], row: number, column: number): number =>
    row === 3 ? (column === 3 ? 1 : 0) : (matrix[4 * row + column] ?? 0);
  return [0, 1, 2].flatMap((row) =>
    [0, 1, 2, 3].map((column) =>
      [0, 1, 2, 3].reduce(
        (sum, inner) => sum + at(after, row, inner) * at(before, inner, column),
        0,
      ),
    ),
  );
}
