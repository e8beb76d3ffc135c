// All that is drawn of a model has bounds that its worker computed: none is computed of vertices while it is drawn.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Texture, Vector3 } from "three";
import { moduleOf } from "../support/module.mjs";

const { boundsOf } = await moduleOf("common/bounds.ts");
const { ModelMesh } = await moduleOf("scene/mesh.ts");
const { deviationGeometry } = await moduleOf("scene/overlays/deviation.ts");

const positions = new Float32Array([0, 0, 0, 3, 0, 1, 0, -4, 0, 2, 2, -5]);
const normals = new Float32Array(12).fill(1);
const indices = new Uint32Array([0, 1, 2, 1, 3, 2]);

/** Asserts that bounds are there, and hold all vertices. */
function assertBounded({ boundingBox, boundingSphere, attributes }) {
  const { min, max } = boundingBox;
  assert.deepEqual([...min.toArray(), ...max.toArray()], [0, -4, -5, 3, 2, 1]);
  for (let vertex = 0; vertex < attributes.position.count; vertex++) {
    const point = new Vector3().fromBufferAttribute(attributes.position, vertex);
    assert.ok(boundingSphere.distanceToPoint(point) <= 1e-9, `${vertex}`);
  }
}

test("the box of points is that of all, and none has one that is empty", () => {
  assert.deepEqual(boundsOf(positions), { min: [0, -4, -5], max: [3, 2, 1] });
  assert.ok(boundsOf(new Float32Array()).min[0] > boundsOf(new Float32Array()).max[0]);
});

test("a model, its paint, its edges and its cap have the bounds of its vertices", () => {
  const model = {
    tessellation: { positions, normals, indices, faces: [{ firstIndex: 0, indexCount: 6 }] },
    outline: { edges: new Uint32Array([0, 1]), ends: [2] },
    bounds: boundsOf(positions),
    faceColors: [],
  };
  const mesh = new ModelMesh(model, "a", "#336699", new Texture());
  mesh.close();
  const geometry = deviationGeometry({
    ...{ positions, normals, indices, bounds: boundsOf(positions) },
    coordinates: new Float32Array(8),
  });
  mesh.paint(geometry, new Uint32Array(2));
  let count = 0;
  mesh.group.traverse(({ geometry }) => {
    if (geometry?.attributes.position === undefined) return;
    assertBounded(geometry);
    count += 1;
  });
  assert.equal(count, 6);
  // Bodies that are moved apart have other bounds.
  mesh.explode([new Vector3(10, 0, 0)]);
  assert.equal(geometry.boundingSphere, null);
});
