// Workers of a pool: what they measure is what the first one measures, and where one fails its call is rejected once.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { node } from "../../../dist/worker/platform/node.js";
import { Pool } from "../../../dist/worker/pool/pool.js";
import { Target } from "../../../dist/worker/pool/target.js";
import { measureBlocks } from "../../../dist/worker/pool/work.js";
import { serve } from "../../../dist/worker/serve.js";
import { stepSquares } from "../../page/support/models.mjs";
import { create, square, withCode } from "../support.mjs";

const start = node(new URL("../../../dist/worker/thread-node.js", import.meta.url));
const { signal } = new AbortController();
const points = Float64Array.from({ length: 3 * 20_000 }, (_, at) => Math.sin(at) * 2);
/** The number of blocks of these. */
const PARTS = Math.ceil(points.length / 3 / 1024);

let hd;
let target;
before(async () => {
  hd = await create({ backend: "cpu" });
  target = new Target(1, hd.shape("torus"), 0);
});
after(() => {
  target.dispose();
  hd.dispose();
});

/**
 * The engine of a first worker that measures its third block when the others have measured all the rest, and the
 * listener to progress that it learns this from: after two the rate is known.
 */
function late(parts) {
  let begun = 0;
  let begin;
  const rest = new Promise((resolve) => {
    begin = resolve;
  });
  const last = (parts - 1.5) / parts;
  const after =
    (method) =>
    async (...args) => {
      args.at(-1).signal.addEventListener("abort", begin);
      begun += 1;
      if (begun > 2) await rest;
      return hd[method](...args);
    };
  const engine = {
    closestPointsOfBlock: after("closestPointsOfBlock"),
    signedDistancesOfLayer: after("signedDistancesOfLayer"),
    layersOfGrid: (...args) => hd.layersOfGrid(...args),
  };
  return { engine, onProgress: (fraction) => fraction > last && begin() };
}

/** A pool, and the ports to its other workers. */
function pool(engine, workers) {
  const ports = [];
  const connect = (...args) => ports[ports.push(start(...args)) - 1];
  return { ports, pool: new Pool(engine, connect, { workers, memory: 2 ** 31 }) };
}

/** What a pool finds whose other workers measure all but one of some parts. */
async function byOthers({ workers, parts }, work) {
  const { engine, onProgress } = late(parts);
  const { ports, pool: own } = pool(engine, workers);
  const found = await work(own, { signal, onProgress });
  for (const port of ports) port.close();
  return found;
}

const MODELS = {
  "a NURBS model": () => hd.shape("torus"),
  "trimmed faces of a file": () => hd.readCad(new TextEncoder().encode(stepSquares(2))),
  "a mesh": () =>
    hd.mesh({
      positions: points.slice(0, 900),
      triangles: Array.from({ length: 300 }, (_, k) => k),
    }),
};

for (const [what, make] of Object.entries(MODELS)) {
  test(`points measured from ${what} by other workers are those of the first`, async () => {
    const model = await make();
    const options = { relativeTolerance: 1e-4, transform: { translation: [0.1, 0, 0] } };
    const expected = await hd.closestPoints(model, points, options);
    const of = new Target(2, model, 0);
    for (const workers of [2, 3]) {
      const found = await byOthers({ workers, parts: PARTS }, (own, work) =>
        own.closestPoints(of, points, options, work),
      );
      assert.deepStrictEqual(found, expected);
    }
    of.dispose();
    model.dispose();
  });
}

test("layers of a grid measured by another worker are those of the first", async () => {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const model = hd.mesh({ positions, triangles: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] });
  const options = { resolution: 60, band: 0.125, precision: "float32" };
  const expected = await hd.signedDistances(model, options);
  const of = new Target(3, model, 0);
  const parts = Math.ceil(expected.counts[2] / 8);
  const found = await byOthers({ workers: 2, parts }, (own, work) =>
    own.signedDistances(of, options, work),
  );
  assert.deepStrictEqual(found, expected);
  of.dispose();
  model.dispose();
});

test("a worker that ends rejects its call once, and a later call has another one", async () => {
  const { engine, onProgress: begin } = late(PARTS);
  const { ports, pool: own } = pool(engine, 3);
  let ended = false;
  const onProgress = (fraction) => {
    if (fraction < 0.5 || ended) return;
    ports[0].close();
    ended = true;
  };
  const work = { signal, onProgress };
  await assert.rejects(
    own.closestPoints(target, points, {}, work),
    withCode("WORKER_FAILED", /ended/),
  );
  assert.equal(own.workers, 2);
  const found = await own.closestPoints(target, points, {}, { signal, onProgress: begin });
  assert.deepStrictEqual(found, await hd.closestPoints(target.model, points));
  assert.equal(ports.length, 3);
  for (const port of ports) port.close();
});

test("a worker that does not start rejects the call", async () => {
  const connect = node(new URL("file:///no-such-folder/thread.js"));
  const own = new Pool(late(PARTS).engine, connect, { workers: 2, memory: 2 ** 31 });
  await assert.rejects(
    own.closestPoints(target, points, {}, { signal }),
    withCode("WORKER_FAILED", /no-such-folder/),
  );
  assert.equal(own.workers, 1);
});

test("a signal ends the blocks of all workers", async () => {
  const { ports, pool: own } = pool(late(PARTS).engine, 3);
  const controller = new AbortController();
  const reason = new Error("enough");
  const onProgress = (fraction) => fraction > 0.5 && controller.abort(reason);
  const work = { signal: controller.signal, onProgress };
  await assert.rejects(own.closestPoints(target, points, {}, work), (error) => {
    assert.equal(error.cause, reason);
    return withCode("CANCELLED")(error);
  });
  assert.equal(own.workers, 3);
  for (const port of ports) port.close();
});

/** So many that measuring them takes many times as long as making the model of a square. */
const many = Float64Array.from({ length: 3 * 80_000 }, (_, at) => Math.sin(at) * 2);

/** A first worker in this thread beside one that answers at once, with zeros, and notes what it is asked. */
function served() {
  const asked = [];
  const zeros = (count) => new Float64Array(count);
  const answers = {
    create: () => undefined,
    source: () => ({}),
    closestPointsOfBlock: ([, { length }]) => ({
      ...{ distances: zeros(length / 3), bounds: zeros(length / 3), signed: zeros(length / 3) },
      ...{ feet: zeros(length), parameters: zeros((2 * length) / 3), signs: "faces" },
      faces: new Uint32Array(length / 3),
    }),
  };
  const answer = (method, args) =>
    asked.failing
      ? { failure: { code: undefined, message: "unreachable" } }
      : { result: answers[method](args) };
  const connect = (listener) => ({
    post: ({ id, method, args, drop }) => {
      asked.push(method ?? { drop });
      if (method) queueMicrotask(() => listener.message({ id, ...answer(method, args) }));
    },
    hold: () => {},
    close: () => {},
  });
  const waiting = new Map();
  const take = serve(
    ({ id, result, failure }) => {
      if (failure) waiting.get(id).reject(failure);
      else waiting.get(id).resolve(result);
    },
    { connect, processors: () => 2 },
  );
  const call = (id, method, ...args) =>
    new Promise((resolve, reject) => {
      waiting.set(id, { resolve, reject });
      take({ id, method, args });
    });
  return { asked, take, call };
}

test("a copy of a model is sent once, and dropped when the model is changed or dropped", async () => {
  const { asked, take, call } = served();
  await call(1, "create", { backend: "cpu" }, { workers: "auto" });
  const own = [2, 3];
  for (const id of own) await call(id, "model", [square(id)]);
  const measure = async (id, model) => {
    asked.length = 0;
    await call(id, "closestPoints", model, many, {});
    return new Set(asked);
  };
  assert.deepEqual(await measure(4, 2), new Set(["create", "source", "closestPointsOfBlock"]));
  assert.deepEqual(await measure(5, 2), new Set(["closestPointsOfBlock"]));
  assert.deepEqual(await measure(6, 3), new Set(["source", "closestPointsOfBlock"]));
  await call(7, "update", 2, 0, square(5).controlPoints, {});
  take({ drop: 3 });
  const { distances } = await call(8, "closestPoints", 2, many, {});
  assert.ok(
    distances.every((distance) => distance >= 3),
    "all from the changed model",
  );
  // The numbers of its calls that made these models.
  assert.deepEqual(asked.filter((one) => typeof one === "object").length, 2);
  assert.ok(!(await measure(9, 2)).has("closestPointsOfBlock"));
});

test("a worker whose module fails rejects its call, and a later call has another one", async () => {
  const { asked, call } = served();
  await call(1, "create", { backend: "cpu" }, { workers: 2 });
  await call(2, "model", [square(0)]);
  await call(3, "closestPoints", 2, many, {});
  asked.failing = true;
  await assert.rejects(call(4, "closestPoints", 2, many, {}), { message: "unreachable" });
  asked.failing = false;
  asked.length = 0;
  await call(5, "closestPoints", 2, many, {});
  assert.deepEqual(new Set(asked), new Set(["create", "source", "closestPointsOfBlock"]));
});

/** Ten blocks, the numbers from 0 on, whose sum is found. */
function numbers() {
  let [taken, done, sum] = [0, 0, 0];
  return {
    take: () => (taken < 10 ? taken++ : undefined),
    put: (_, part) => {
      done += 1;
      sum += part;
    },
    get fraction() {
      return done / 10;
    },
    get found() {
      return sum;
    },
  };
}

const later = () => new Promise((resolve) => setImmediate(resolve));

test("each block is measured once, and one that is never ready is not waited for", async () => {
  const measured = [];
  const measure = async (block) => {
    await later();
    measured.push(block);
    return block;
  };
  const never = new Promise(() => {});
  const of = [measure, measure, undefined].map((one) => Promise.resolve(one));
  const fractions = [];
  const onProgress = (fraction) => fractions.push(fraction);
  assert.equal(await measureBlocks(numbers(), [never, ...of], { signal, onProgress }), 45);
  assert.deepEqual(measured.sort(), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  assert.equal(fractions.at(-1), 1);
});

test("an error of one ends the others, and is thrown once their blocks have ended", async () => {
  let ended = false;
  const slow = async (block, signal) => {
    while (!signal.aborted) await later();
    await later();
    ended = true;
    return block;
  };
  const thrown = new RangeError("of one");
  const failing = async () => {
    await later();
    throw thrown;
  };
  const measures = [slow, failing].map((one) => Promise.resolve(one));
  await assert.rejects(measureBlocks(numbers(), measures, { signal }), (error) => {
    assert.equal(error, thrown);
    return ended;
  });
  // An error of one that prepares ends them too.
  const unready = [Promise.resolve(slow), Promise.reject(thrown)];
  await assert.rejects(measureBlocks(numbers(), unready, { signal }), thrown);
});
