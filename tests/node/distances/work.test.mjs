// Progress, cancelling, and several distances at once.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, givesWay, near, square, withCode } from "../support.mjs";

let hd;
let a;
let b;
before(async () => {
  hd = await create();
  a = hd.shape("wavy-sheet");
  b = hd.shape("wavy-sheet-b");
});
after(() => {
  a.dispose();
  b.dispose();
  hd.dispose();
});

/** A second's work at least, on the CPU or on lavapipe. */
const long = { method: "iteration", samples: 512, culling: "none" };

/**
 * A bicubic sheet with a weight of its own: a large one makes the bounds of derivatives useless on
 * large cells, so that a search takes seconds.
 */
function sheet(weight) {
  const knots = [0, 0, 0, 0, 1, 1, 1, 1];
  const controlPoints = Array.from({ length: 16 }, (_, index) => {
    const [x, y] = [Math.floor(index / 4) / 3, (index % 4) / 3];
    return [x, y, 0.3 * Math.sin(5 * x) * Math.cos(4 * y), index === 5 ? weight : 1];
  }).flat();
  return hd.model([
    { degree: [3, 3], knotsU: knots, knotsV: knots, counts: [4, 4], controlPoints },
  ]);
}

test("a search that gains nothing says so", async () => {
  const seen = [];
  await hd.distance(sheet(1e8), sheet(1), {
    backend: "cpu",
    maxCells: 200000,
    onProgress: (_fraction, _interval, stalled) => seen.push(stalled),
  });
  assert.equal(seen[0], false);
  assert.ok(seen.includes(true));
});

for (const backend of ["gpu", "cpu"]) {
  test(`progress on the ${backend} rises to 1`, async () => {
    const seen = [];
    await hd.distance(a, b, {
      method: "iteration",
      samples: 300,
      symmetric: true,
      backend,
      onProgress: (fraction) => seen.push(fraction),
    });
    assert.ok(seen.length > 2);
    assert.equal(seen.at(-1), 1);
    assert.ok(seen.every((fraction, index) => index === 0 || fraction >= seen[index - 1]));
    assert.ok(seen.every((fraction) => fraction >= 0 && fraction <= 1));
  });

  test(`a signal cancels work in progress on the ${backend}`, async () => {
    const controller = new AbortController();
    const reason = new Error("the user moved on");
    let fractions = 0;
    const work = hd.distance(a, b, {
      ...long,
      backend,
      signal: controller.signal,
      onProgress: (fraction) => {
        fractions += 1;
        // From outside, as a page's button does, once work has begun.
        if (fraction > 0) setTimeout(() => controller.abort(reason));
      },
    });
    await assert.rejects(work, (error) => {
      assert.equal(error.cause, reason);
      return withCode("CANCELLED")(error);
    });
    assert.ok(fractions > 1);
  });
}

test("the event loop turns while work is done", async () => {
  let turns = 0;
  const timer = setInterval(() => {
    turns += 1;
  }, 1);
  await hd.distance(a, b, { method: "iteration", samples: 512, backend: "cpu" });
  clearInterval(timer);
  assert.ok(turns > 3, `${turns} turns`);
});

test("method hierarchy gives way while it prepares and while it measures", async () => {
  // Every grid but the last is prepared anew. One so fine takes many times as long as the turns are apart.
  let grid = 384;
  await givesWay(() => {
    grid += 1;
    return hd.distance(a, b, { method: "hierarchy", grid, backend: "cpu" });
  });
});

test("work cancelled before it begins does not begin", async () => {
  const onProgress = () => assert.fail("it began");
  await assert.rejects(
    hd.distance(a, b, { signal: AbortSignal.abort(), onProgress }),
    withCode("CANCELLED"),
  );
});

test("certified work that is cancelled rejects with the interval so far", async () => {
  const controller = new AbortController();
  // Tens of thousands of cells: two hulls of about equal distance all over.
  const [hull, wider] = ["wigley-hull", "wigley-hull-wider"].map((name) => hd.shape(name));
  const { lower, upper } = await hd.distance(hull, wider, { relativeTolerance: 1e-4 });
  const reason = new Error("enough");
  for (const symmetric of [false, true]) {
    const work = hd.distance(hull, wider, {
      ...{ relativeTolerance: 1e-12, symmetric, signal: controller.signal },
      onProgress: (fraction) => fraction > 0 && controller.abort(reason),
    });
    await assert.rejects(work, (error) => {
      assert.equal(error.cause, reason);
      // The second call is cancelled before it begins, and has no interval.
      if (symmetric) assert.equal(error.interval, undefined);
      else assert.ok(error.interval[0] <= upper && lower <= error.interval[1]);
      return withCode("CANCELLED")(error);
    });
  }
});

test("cancelled work by method hierarchy, and by diff, rejects", async () => {
  for (const run of [
    (options) => hd.distance(a, b, { ...options, method: "hierarchy", grid: 256 }),
    (options) => hd.diff(sheet(1e8), sheet(1), options),
    (options) => hd.field(a, b, { ...options, samples: 256 }),
    (options) => hd.closestPoints(a, new Float64Array(300_000), options),
    (options) => hd.bestFit(a, b, { ...options, samples: 128 }),
  ]) {
    const controller = new AbortController();
    const options = { signal: controller.signal, onProgress: () => controller.abort() };
    await assert.rejects(run(options), withCode("CANCELLED"));
    await assert.rejects(run(options), withCode("CANCELLED"), "before it begins");
  }
});

test("a signal aborted by the last report still rejects, with the interval", async () => {
  const controller = new AbortController();
  const onProgress = (fraction) => fraction === 1 && controller.abort();
  const [plane, above] = [hd.model([square(0)]), hd.model([square(1)])];
  await assert.rejects(
    hd.distance(plane, above, { signal: controller.signal, onProgress }),
    (error) => {
      assert.ok(error.interval[0] <= 1 && 1 <= error.interval[1]);
      return withCode("CANCELLED")(error);
    },
  );
});

test("what onProgress throws ends the work and is thrown on", async () => {
  const thrown = new RangeError("from the callback");
  const onProgress = () => {
    throw thrown;
  };
  for (const method of ["iteration", "certified"]) {
    await assert.rejects(hd.distance(a, b, { method, onProgress }), (error) => error === thrown);
  }
});

test("after cancelled and refused work the next is right", async () => {
  const plane = hd.model([square(0)]);
  const above = hd.model([square(1)]);
  const near1 = async (options) => {
    const { computed } = await hd.distance(plane, above, {
      method: "iteration",
      samples: 8,
      ...options,
    });
    near(computed, 1, 1e-12);
  };
  const controller = new AbortController();
  const cancelled = hd.distance(a, b, { ...long, signal: controller.signal });
  const refused = hd.distance(a, b, { method: "iteration", samples: 0 });
  const next = [near1(), near1({ backend: "cpu" }), near1({ symmetric: true })];
  setTimeout(() => controller.abort(), 20);
  await assert.rejects(cancelled, withCode("CANCELLED"));
  await assert.rejects(refused, withCode("OPTION_OUT_OF_RANGE"));
  await Promise.all(next);
});

test("distances requested at once are computed in turn", async () => {
  const running = new Set();
  let most = 0;
  const one = async (index) => {
    const onProgress = (fraction) => {
      running.add(index);
      most = Math.max(most, running.size);
      if (fraction === 1) running.delete(index);
    };
    return (await hd.distance(a, b, { method: "iteration", samples: 32, onProgress })).computed;
  };
  const computed = await Promise.all([0, 1, 2, 3].map(one));
  assert.equal(most, 1);
  assert.deepEqual(computed, Array(4).fill(computed[0]));
});

test("engines work side by side on the same models", async () => {
  const other = await create();
  const options = { method: "iteration", samples: 48, symmetric: true };
  const [first, second] = await Promise.all([
    hd.distance(a, b, options),
    other.distance(a, b, options),
  ]);
  assert.equal(first.computed, second.computed);
});

test("progress may start another distance", async () => {
  const plane = hd.model([square(0)]);
  let inner;
  await hd.distance(a, b, {
    method: "iteration",
    samples: 16,
    onProgress: () => {
      inner ??= hd.distance(plane, plane, { method: "iteration", samples: 4 });
    },
  });
  near((await inner).computed, 0, 1e-12);
});
