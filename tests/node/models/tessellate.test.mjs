import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { create, near, square, withCode } from "../support.mjs";

let hd;
before(async () => {
  hd = await create({ backend: "cpu" });
});
after(() => hd.dispose());

test("a square is two triangles", () => {
  const model = hd.model([square(4)]);
  const { positions, normals, indices, origin, faces } = model.tessellate();
  assert.deepEqual(origin, [0.5, 0.5, 4]);
  assert.ok(positions instanceof Float32Array && normals instanceof Float32Array);
  assert.ok(indices instanceof Uint32Array);
  assert.equal(positions.length, 12);
  assert.deepEqual([...normals], Array(4).fill([0, 0, 1]).flat());
  assert.equal(indices.length, 6);
  assert.deepEqual(faces, [{ firstIndex: 0, indexCount: 6 }]);
});

test("a finer tolerance gives more triangles, all on the sphere", () => {
  const sphere = hd.shape("sphere");
  const [coarse, fine] = [0.1, 0.001].map((tolerance) => sphere.tessellate({ tolerance }));
  assert.ok(fine.indices.length > 10 * coarse.indices.length);
  for (let i = 0; i < fine.positions.length; i += 3) {
    near(Math.hypot(...fine.positions.subarray(i, i + 3)), 2, 1e-6);
  }
});

test("every surface has its triangles", () => {
  const cylinder = hd.shape("cylinder");
  const { indices, faces } = cylinder.tessellate();
  assert.equal(faces.length, cylinder.faceCount);
  let next = 0;
  for (const { firstIndex, indexCount } of faces) {
    assert.equal(firstIndex, next);
    assert.ok(indexCount > 0 && indexCount % 3 === 0);
    next += indexCount;
  }
  assert.equal(next, indices.length);
});

test("wrong tolerances are refused", () => {
  const model = hd.model([square()]);
  assert.throws(() => model.tessellate({ tolerance: 0 }), withCode("OPTION_OUT_OF_RANGE"));
  assert.throws(() => model.tessellate({ tolerance: Number.NaN }), withCode("OPTION_OUT_OF_RANGE"));
  assert.throws(() => model.tessellate({ tolerance: "1" }), withCode("OPTION_INVALID"));
});
