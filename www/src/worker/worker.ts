// The worker, which owns the engine and the two models: computations do not block the page.
import { Hausdorff, HausdorffError } from "nurbs-hausdorff";
import { load } from "./load.ts";
import { engineState, Measurements } from "./measurements.ts";
import type { Reply, Request } from "./protocol.ts";

const ready = start();
ready.catch(fail);
// Loads are done in turn, so a small file does not overtake a large one.
let loaded: Promise<void> = Promise.resolve();

self.onmessage = async ({ data }: MessageEvent<Request>) => {
  let started: Awaited<typeof ready>;
  try {
    started = await ready;
  } catch (error) {
    fail(error);
    return;
  }
  const { engine, measurements } = started;
  if (data.kind === "measure") measurements.request(data.run, data.options);
  else if (data.kind === "cancel") measurements.cancel();
  else loaded = loaded.then(() => replace(engine, measurements, data));
};

async function replace(
  engine: Hausdorff,
  measurements: Measurements,
  { sources, placement }: Extract<Request, { kind: "load" }>,
): Promise<void> {
  try {
    const { models, display } = await load(engine, sources);
    measurements.replace(models);
    const transfer = Object.values(display).flatMap(({ tessellation, outline }) => [
      tessellation.positions.buffer,
      tessellation.normals.buffer,
      tessellation.indices.buffer,
      outline.buffer,
    ]);
    reply({ kind: "loaded", models: display, placement }, transfer);
  } catch (error) {
    fail(error);
  }
}

async function start() {
  const engine = await Hausdorff.create();
  reply({ kind: "ready", engine: engineState(engine), shapes: Hausdorff.shapes() });
  return { engine, measurements: new Measurements(engine, reply, fail) };
}

function reply(message: Reply, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

function fail(error: unknown, run?: number): void {
  const code = error instanceof HausdorffError ? error.code : "UNEXPECTED";
  const message = error instanceof Error ? error.message : `${error}`;
  reply({ kind: "failed", ...(run === undefined ? {} : { run }), code, message });
}
