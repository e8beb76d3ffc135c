import assert from "node:assert/strict";
import { test } from "node:test";
import { Latest } from "../../../dist/node.js";
import { create, square, withCode } from "../support.mjs";

/** Work that ends when it is told to, or rejects once its signal is aborted. */
function controlled() {
  let end;
  const work = (signal) =>
    new Promise((resolve, reject) => {
      end = resolve;
      signal.addEventListener("abort", () => reject(new Error("aborted")));
    });
  return { work, end: (value) => end(value) };
}

test("a newer request cancels the one in progress, which resolves to undefined", async () => {
  const latest = new Latest();
  const [first, second] = [controlled(), controlled()];
  const replaced = latest.run(first.work);
  const kept = latest.run(second.work);
  assert.equal(await replaced, undefined);
  second.end("second");
  assert.equal(await kept, "second");
});

test("a request that ignores its signal is replaced as well", async () => {
  const latest = new Latest();
  let end;
  const replaced = latest.run(() => new Promise((resolve) => (end = resolve)));
  const kept = latest.run(async () => 2);
  end(1);
  assert.deepEqual(await Promise.all([replaced, kept]), [undefined, 2]);
});

test("cancel rejects the request in progress, and drop resolves it to undefined", async () => {
  const latest = new Latest();
  const cancelled = latest.run(controlled().work);
  latest.cancel();
  await assert.rejects(cancelled, /aborted/);
  const dropped = latest.run(controlled().work);
  latest.drop();
  assert.equal(await dropped, undefined);
  await assert.rejects(
    latest.run(async () => {
      throw new Error("failed");
    }),
    /failed/,
  );
});

test("distances of a model that moves are those of its newest position", async () => {
  const hd = await create({ backend: "cpu" });
  const [a, b] = [hd.model([square()]), hd.model([square()])];
  const latest = new Latest();
  const heights = [1, 2, 3];
  const results = await Promise.all(
    heights.map((z) =>
      latest.run((signal) => hd.distance(a, b, { signal, transform: { translation: [0, 0, z] } })),
    ),
  );
  assert.deepEqual(results.slice(0, 2), [undefined, undefined]);
  assert.ok(results[2].lower <= 3 && 3 <= results[2].upper);
  const cancelled = latest.run((signal) => hd.distance(a, b, { signal }));
  latest.cancel();
  await assert.rejects(cancelled, withCode("CANCELLED"));
  hd.dispose();
});
