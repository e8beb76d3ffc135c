// A program that uses the package as its documentation says, for the type checker.
import {
  type DistanceOptions,
  type DistanceResult,
  type ErrorCode,
  Hausdorff,
  HausdorffError,
  type InterchangeModel,
  type IterationOptions,
  type IterationResult,
  type NurbsModel,
  type ShapeInfo,
  type SurfaceArrays,
  type Tessellation,
} from "nurbs-hausdorff";
import { fromOcct, fromRhino, fromThree, fromVerb } from "nurbs-hausdorff/adapters";
import { type CadReport, convertCad, readCad } from "nurbs-hausdorff/cad";
import * as away from "nurbs-hausdorff/worker";

const square: SurfaceArrays = {
  degree: [1, 1],
  knotsU: [0, 0, 1, 1],
  knotsV: new Float64Array([0, 0, 1, 1]),
  counts: [2, 2],
  controlPoints: new Float32Array(16),
  homogeneous: true,
};

const interchange: InterchangeModel = {
  surfaces: [
    { degree: [1, 1], knots_u: [0, 0, 1, 1], knots_v: [0, 0, 1, 1], ctrl: [[[0, 0, 0, 1]]] },
  ],
};

export async function measure(module: Uint8Array<ArrayBuffer>): Promise<number> {
  using hd = await Hausdorff.create({ backend: "auto", module });
  using a = hd.model([square]);
  using b = hd.model(interchange);
  using c: NurbsModel = hd.model(JSON.stringify(interchange));
  using d = hd.shape("sphere");
  const controller = new AbortController();
  const options: IterationOptions = {
    method: "iteration",
    samples: 128,
    sampling: "arc-length",
    flatness: "tight",
    projection: "newton",
    culling: "tree",
    iterations: 10,
    stepTolerance: 1e-3,
    symmetric: true,
    transform: { translation: [0, 0, 1], rotation: [0, 0, 0, 1] },
    backend: "gpu",
    deviations: true,
    signal: controller.signal,
    onProgress: (fraction) => console.log(fraction.toFixed(2)),
  };
  const result: DistanceResult = await hd.distance(a, b, ofAnyMethod(options));
  const [x, y, z]: [number, number, number] = result.witness.a.point;
  const feet: Float64Array | undefined = result.deviations?.[0]?.feet;
  const adapter: string | null = hd.adapter;
  const { min, max } = c.boundingBox;
  console.log(x, y, z, feet, adapter, min[0], max[2], hd.backend, hd.notice, d.name);
  if (result.method === "iteration") return ofIteration(result);
  if (result.method === "hierarchy") return result.pairs[0] ?? 0;
  const within: boolean | undefined = result.within;
  return within ? result.lower : result.upper;
}

/** Options whose type does not say the method. */
function ofAnyMethod(options: DistanceOptions): DistanceOptions {
  return options;
}

function ofIteration({ bounds, forward }: IterationResult): number {
  return (forward?.bounds.kB ?? 0) + bounds.kARigorous;
}

/** The same API in a worker. */
export async function elsewhere(text: string): Promise<number> {
  using hd = await away.Hausdorff.create({ backend: "cpu", workers: "auto", memoryBudget: 512 });
  using a: away.NurbsModel = await hd.model(text);
  const { within } = await hd.distance(a, await hd.shape("sphere"), { limit: 1 });
  const points = new Float64Array(3);
  const { distances } = await hd.closestPoints(a, points, { transfer: true });
  const { transform, rms } = await hd.bestFit(a, a, { samples: 8 });
  const { statistics, deviations } = await hd.field(a, a, { transform, upper: rms });
  const { a: map } = await hd.deviationMaps(a, a, { a: { uppers: [rms] }, transform });
  if (map?.signs === "solid") return map.distances.length;
  if (statistics !== undefined && deviations[0]?.areas.length === 0) return statistics.mean;
  // @ts-expect-error models are the worker's
  await hd.distance(a, inHere().shape("sphere"));
  return within ? (distances[0] ?? 0) : a.faceCount;
}

declare function inHere(): Hausdorff;

/** The method that the options name decides the result's type. */
export async function narrowed(hd: Hausdorff, a: NurbsModel, b: NurbsModel): Promise<boolean> {
  const { within } = await hd.distance(a, b, { limit: 0.1 });
  const { stop } = await hd.distance(a, b);
  const { samples } = await hd.distance(a, b, { method: "iteration" });
  const { pairs } = await hd.distance(a, b, { method: "hierarchy", grid: 32 });
  console.log(stop, samples, pairs.length);
  // @ts-expect-error the grid is an option of another method
  await hd.distance(a, b, { method: "iteration", grid: 32 });
  // @ts-expect-error method `iteration` decides no limit
  console.log((await hd.distance(a, b, { method: "iteration" })).within);
  return within ?? false;
}

export function show(model: NurbsModel): Tessellation {
  const shapes: ShapeInfo[] = Hausdorff.shapes();
  console.log(shapes.map(({ name, title }) => `${name}: ${title}`));
  return model.tessellate({ tolerance: 0.01 });
}

export function explain(error: unknown): ErrorCode | undefined {
  if (!(error instanceof HausdorffError)) return undefined;
  switch (error.code) {
    case "PAIR_BUDGET_EXCEEDED":
    case "CANCELLED":
    case "DISPOSED":
      return error.code;
    // @ts-expect-error no such code
    case "CANCELED":
      return undefined;
    default:
      return error.code;
  }
}

export async function refused(hd: Hausdorff, model: NurbsModel): Promise<void> {
  // @ts-expect-error engines are made by `create`
  new Hausdorff();
  // @ts-expect-error models come from arrays
  hd.model(new Float64Array(16));
  // @ts-expect-error the code is read-only
  new HausdorffError("CANCELLED", "").code = "DISPOSED";
  // @ts-expect-error no such option
  await hd.distance(model, model, { sample: 3 });
  // @ts-expect-error no such rule
  await hd.distance(model, model, { flatness: "flat" });
}

export async function readFiles(hd: Hausdorff, bytes: Uint8Array): Promise<CadReport | null> {
  using part = await readCad(bytes, {
    name: "part.stp",
    unit: 0.001,
    occt: () => ({}),
  });
  const { json, report } = await convertCad(bytes);
  using converted = hd.model(json);
  console.log(
    part.report?.skipped.map(({ face, why }) => `${face}: ${why}`),
    converted.name,
  );
  // @ts-expect-error no such option
  await readCad(bytes, { units: 0.001 });
  // @ts-expect-error files are read by `readCad`
  hd.model(bytes);
  using same = await hd.readCad(bytes, {
    reader: "occt",
    occt: new URL("https://example.org/occt.js"),
  });
  const numbers: (number | undefined)[] = same.report?.skipped.map(({ entity }) => entity) ?? [];
  console.log(same.report?.reader, numbers);
  return report.kind === "step" ? report : part.report;
}

export async function adapt(hd: Hausdorff, oc: object, shape: object): Promise<NurbsModel[]> {
  const three = { degree1: 1, degree2: 1, knots1: [0, 1], knots2: [0, 1], controlPoints: [] };
  const verb = { degreeU: 1, degreeV: 1, knotsU: [], knotsV: [], controlPoints: [] };
  return [
    await hd.readCad(fromOcct(oc, shape, { unit: 0.0254 }), { name: "part" }),
    hd.model(fromRhino(shape, { name: "part" })),
    hd.model(fromThree(three)),
    hd.model(fromVerb({ asNurbs: () => verb })),
  ];
}
