// Faces in the colours of their classes, of which those that are hidden are not drawn.
import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferAttribute, BufferGeometry } from "three";
import { moduleOf } from "../support/module.mjs";

const { FaceColors } = await moduleOf("scene/faces.ts");

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
