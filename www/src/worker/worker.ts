// The page's worker, which draws up what the page shows: nothing of it blocks the page. The
// package's worker, which it starts, holds the models and measures them.
import { Hausdorff } from "nurbs-hausdorff/worker";
import { examples } from "../examples/index.ts";
import { BodyTasks } from "./bodyTasks.ts";
import { Comparisons } from "./comparisons.ts";
import { codeOf, messageOf } from "./failure.ts";
import { csvOf } from "./map/csv.ts";
import { engineState, Measurements } from "./measurements.ts";
import { load } from "./models/load.ts";
import { isMesh } from "./models/meshes.ts";
import { probe } from "./probe.ts";
import {
  type Draft,
  type Reply,
  type Request,
  SIDES,
  type Side,
  type Sides,
  type Source,
} from "./protocol.ts";

type Started = Awaited<ReturnType<typeof start>>;

const ready = start();
ready.catch(fail);
// Loads are done in turn, so a small file does not overtake a large one.
let loaded: Promise<void> = Promise.resolve();

self.onmessage = async ({ data }: MessageEvent<Request>) => {
  try {
    const started = await ready;
    take(started, data);
  } catch (error) {
    fail(error);
  }
};

function take(started: Started, data: Request): void {
  const { measurements } = started;
  switch (data.kind) {
    case "measure":
      measurements.request(data);
      break;
    case "cancel":
      measurements.cancel();
      break;
    case "probe":
      void reportProbe(started, data);
      break;
    case "csv":
      reply({ kind: "csv", table: csvOf([...measurements.painted]) });
      break;
    case "load":
      loaded = loaded.then(() => replace(started, data));
      break;
    case "restore":
      loaded = loaded.then(() => restore(started, data.sources));
      break;
    case "bodies":
    case "facts":
    case "overlap":
    case "cancelOverlap":
    case "check":
    case "cancelCheck":
      takeOfBodies(started, data);
      break;
    default:
      takeOfPair(started, data);
  }
}

/** Requests of one kind. */
type Of<Kind extends Request["kind"]> = Extract<Request, { kind: Kind }>;

/** Takes what is about bodies. */
function takeOfBodies(
  { measurements: { models }, bodyTasks }: Started,
  data: Of<"bodies" | "facts" | "overlap" | "cancelOverlap" | "check" | "cancelCheck">,
): void {
  switch (data.kind) {
    case "bodies":
      // Models that are replaced meanwhile have no bodies to be moved.
      void bodyTasks.bodies({ ...models }).then(
        (faces) => reply({ kind: "bodies", faces }),
        () => {},
      );
      break;
    case "facts":
      void bodyTasks.facts({ ...models });
      break;
    case "overlap":
      if (models.a && models.b) void bodyTasks.overlap(models.a, models.b, data.options);
      break;
    case "cancelOverlap":
      bodyTasks.cancelOverlap();
      break;
    case "check":
      void bodyTasks.check({ ...models }, data.of, {
        ...{ options: data.options, transform: data.transform },
      });
      break;
    case "cancelCheck":
      bodyTasks.cancelCheck();
      break;
  }
}

/** Takes what compares both models beside the measurement. */
function takeOfPair(
  { measurements, comparisons }: Started,
  data: Of<
    | ("diff" | "cancelDiff" | "bound" | "cancelBound")
    | ("fit" | "cancelFit" | "clearance" | "cancelClearance")
  >,
): void {
  const { a, b } = measurements.models;
  switch (data.kind) {
    case "diff":
      if (a && b) void comparisons.compareFaces({ a, b }, data.options);
      break;
    case "cancelDiff":
      comparisons.cancelFaces();
      break;
    case "bound":
      if (a && b) void comparisons.boundFaces({ a, b }, data.run, data.options);
      break;
    case "cancelBound":
      comparisons.cancelBounds();
      break;
    case "fit":
      if (a && b) void comparisons.fit({ a, b }, data.options);
      break;
    case "cancelFit":
      comparisons.cancelFit();
      break;
    case "clearance":
      if (a && b) void comparisons.clearance({ a, b }, data.options);
      break;
    case "cancelClearance":
      comparisons.cancelClearance();
      break;
  }
}

async function replace(
  { engine, measurements, comparisons, bodyTasks }: Started,
  { sources, placement }: Extract<Request, { kind: "load" }>,
): Promise<void> {
  try {
    const replaced = SIDES.filter((side) => sources[side] !== undefined);
    const { models, display } = await load(engine, sources, {
      onLibrary: (text) => reply({ kind: "loading", text }),
      onDraft: (side, draft) => reply({ kind: "draft", side, replaced, draft }, buffersOf(draft)),
    });
    comparisons.drop();
    bodyTasks.drop();
    bodyTasks.replaced(sources);
    measurements.replace(models);
    const transfer = Object.values(display).flatMap(({ tessellation, outline }) => [
      tessellation.positions.buffer,
      tessellation.normals.buffer,
      tessellation.indices.buffer,
      outline.edges.buffer,
    ]);
    reply({ kind: "loaded", models: display, placement }, transfer);
    void reportClosed(measurements);
  } catch (error) {
    fail(error);
  }
}

async function restore(
  { engine, measurements, bodyTasks }: Started,
  sources: Sides<Source>,
): Promise<void> {
  try {
    // What was loaded since is newer.
    const missing = Object.fromEntries(
      Object.entries(sources).filter(([side]) => measurements.models[side as Side] === undefined),
    );
    const { models } = await load(engine, missing, { onLibrary: () => {}, onDraft: () => {} });
    measurements.replace(models);
    bodyTasks.replaced(missing);
    reply({ kind: "restored" });
  } catch (error) {
    fail(error);
  }
}

/** Says of the models in turn whether they are closed: they are drawn before it is known. */
async function reportClosed({ models }: Measurements): Promise<void> {
  for (const side of SIDES) {
    const model = models[side];
    if (model === undefined || isMesh(model)) continue;
    // A model that is replaced meanwhile is nobody's.
    const solid = await model.solid().catch(() => undefined);
    if (solid?.closed && models[side] === model) reply({ kind: "closed", side });
  }
}

function buffersOf({ edges, positions, normals, indices }: Draft): ArrayBuffer[] {
  return [edges, positions, normals, indices].map(({ buffer }) => buffer);
}

async function reportProbe(
  { engine, measurements }: Started,
  { id, ...at }: Extract<Request, { kind: "probe" }>,
): Promise<void> {
  // A point that cannot be measured, for example while models are replaced, is not reported.
  const found = await probe(engine, measurements.models, at).catch(() => undefined);
  reply({ kind: "probed", id, probe: found });
}

async function start() {
  const worker = new Worker(new URL("./engine.ts", import.meta.url), { type: "module" });
  const engine = await Hausdorff.create({ worker, workers: "auto" });
  const shapes = [...examples, ...(await engine.shapes())];
  reply({ kind: "ready", engine: engineState(engine), shapes });
  const measurements = new Measurements(engine, reply, fail);
  const comparisons = new Comparisons(engine, reply, (run, faces) =>
    measurements.bound(run, faces),
  );
  return { engine, measurements, comparisons, bodyTasks: new BodyTasks(engine, reply) };
}

function reply(message: Reply, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

function fail(error: unknown, run?: number): void {
  const failed = { code: codeOf(error), message: messageOf(error) };
  reply({ kind: "failed", ...(run === undefined ? {} : { run }), ...failed });
}
