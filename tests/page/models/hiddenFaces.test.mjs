// Faces in the colours of their classes, of which those that are hidden are not drawn.
import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferAttribute, BufferGeometry } from "three";
import { moduleOf } from "../support/module.mjs";

const { FaceColors } = await moduleOf("scene/faces.ts");
const { ModelMesh } = await moduleOf("scene/mesh.ts");

test("faces that are hidden after they were coloured are no longer drawn, and drawn again", () => {
  const source = new BufferGeometry();
  for (const name of ["position", "normal"]) {
    source.setAttribute(name, new BufferAttribute(new Float32Array(18), 3));
  }
  const tessellation = {
    indices: new Uint32Array([0, 1, 2, 3, 4, 5]),
    faces: [
      { firstIndex: 0, indexCount: 3 },
      { firstIndex: 3, indexCount: 3 },
    ],
  };
  const colors = new FaceColors(source, tessellation, "a", "#2b78bd");
  const drawn = () => colors.mesh.geometry.groups.reduce((sum, { count }) => sum + count, 0);
  colors.hidden = new Set([1]);
  assert.equal(colors.mesh.visible, false);
  colors.show(["changed", "plain"]);
  assert.equal(drawn(), 3);
  colors.hidden = new Set();
  assert.equal(drawn(), 6);
  colors.hidden = new Set([0]);
  assert.equal(drawn(), 3);
  assert.equal(colors.mesh.visible, true);
});

test("triangles of a mesh are flat in all their colours, and surfaces are smooth", () => {
  for (const isMesh of [true, false]) {
    const tessellation = {
      ...{ positions: new Float32Array(9), normals: new Float32Array(9), origin: [0, 0, 0] },
      ...{ indices: new Uint32Array([0, 1, 2]), faces: [{ firstIndex: 0, indexCount: 3 }] },
    };
    const model = {
      ...{ tessellation, isMesh, faceCount: 1, outline: { edges: new Uint32Array() } },
      bounds: { min: [0, 0, 0], max: [1, 1, 1] },
    };
    const { group } = new ModelMesh(model, "a", "#2b78bd", null);
    const shaded = [];
    group.traverse(({ material = [] }) => {
      shaded.push(...[material].flat().filter((one) => "flatShading" in one));
    });
    assert.ok(shaded.length > 7, `${shaded.length}`);
    assert.ok(shaded.every(({ flatShading }) => flatShading === isMesh));
  }
});
