// Owns the engine and the two models, so that no work freezes the page.
import { Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import type { PlainOptions, Reply, Request, Side, Source } from "./protocol.ts";

const models: Partial<Record<Side, NurbsModel>> = {};
let engine: Hausdorff | undefined;
let running: AbortController | undefined;
// The newest measurement asked for while another ran; older ones are dropped.
let waiting: { run: number; options: PlainOptions } | undefined;

const started = start();

self.onmessage = async ({ data }: MessageEvent<Request>) => {
  await started;
  if (engine === undefined) return;
  if (data.kind === "load") load(engine, data.side, data.source);
  else if (data.kind === "cancel") running?.abort();
  else {
    waiting = { run: data.run, options: data.options };
    if (running === undefined) void measureAll(engine);
    else running.abort();
  }
};

async function start(): Promise<void> {
  try {
    engine = await Hausdorff.create();
    const { backend, adapter, notice } = engine;
    reply({ kind: "ready", backend, adapter, notice, shapes: Hausdorff.shapes() });
  } catch (error) {
    fail("start", error);
  }
}

function load(engine: Hausdorff, side: Side, source: Source): void {
  try {
    const model = "shape" in source ? engine.shape(source.shape) : engine.model(source.json);
    const tessellation = model.tessellate();
    models[side]?.dispose();
    models[side] = model;
    const name = "shape" in source ? source.shape : source.name;
    const shown = { name, surfaceCount: model.surfaceCount, box: model.boundingBox, tessellation };
    const { positions, normals, indices } = tessellation;
    reply({ kind: "loaded", side, shown }, [positions.buffer, normals.buffer, indices.buffer]);
  } catch (error) {
    fail(side, error);
  }
}

async function measureAll(engine: Hausdorff): Promise<void> {
  while (waiting !== undefined) {
    const { run, options } = waiting;
    waiting = undefined;
    if (models.a === undefined || models.b === undefined) return;
    running = new AbortController();
    try {
      const result = await engine.distance(models.a, models.b, {
        ...options,
        signal: running.signal,
        onProgress: (fraction, interval) => reply({ kind: "progress", run, fraction, interval }),
      });
      reply({ kind: "measured", run, result });
    } catch (error) {
      if (error instanceof HausdorffError && error.code === "CANCELLED") {
        reply({ kind: "cancelled", run });
      } else fail("measure", error);
    }
    running = undefined;
  }
}

function reply(message: Reply, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

function fail(about: Side | "measure" | "start", error: unknown): void {
  const code = error instanceof HausdorffError ? error.code : "ERROR";
  reply({
    kind: "failed",
    about,
    code,
    message: error instanceof Error ? error.message : `${error}`,
  });
}
