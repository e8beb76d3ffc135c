import type {
  InterchangeInstance,
  InterchangeModel,
  InterchangeSurface,
} from "../../model/surface.js";

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** The faces and placements of several models as those of one, with their own numbers of edges. */
export function joined(
  models: readonly InterchangeModel[],
): Pick<InterchangeModel, "surfaces" | "instances"> {
  const surfaces: InterchangeSurface[] = [];
  const instances: InterchangeInstance[] = [];
  let edges = 0;
  for (const model of models) {
    const first = surfaces.length;
    const own = model.surfaces.map((face) => withEdgesFrom(face, edges));
    const all = own.map((_, index) => index);
    const placed = model.instances ?? [{ surfaces: all, transform: IDENTITY }];
    instances.push(
      ...placed.map((one) => ({ ...one, surfaces: one.surfaces.map((index) => index + first) })),
    );
    for (const face of own) {
      surfaces.push(face);
      edges = Math.max(edges, ...(face.trim ?? []).flat().map(({ edge = -1 }) => edge + 1));
    }
  }
  return models.some(({ instances }) => instances) ? { surfaces, instances } : { surfaces };
}

/** The face with the numbers of its edges raised by `first`. */
function withEdgesFrom(face: InterchangeSurface, first: number): InterchangeSurface {
  if (face.trim === undefined || first === 0) return face;
  const trim = face.trim.map((loop) =>
    loop.map((curve) =>
      curve.edge === undefined ? curve : { ...curve, edge: curve.edge + first },
    ),
  );
  return { ...face, trim };
}
