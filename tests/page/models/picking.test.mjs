// What the pointer hits among many triangles and points: by a tree, the same as one by one; what is hidden or cut away is
// not hit.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  OrthographicCamera,
  PerspectiveCamera,
  Plane,
  Points,
  PointsMaterial,
  Raycaster,
  Vector2,
  Vector3,
} from "three";
import { drawn } from "../support/drawn.mjs";
import { file } from "../support/models.mjs";
import { moduleOf } from "../support/module.mjs";
import { open, PLAIN } from "../support/open.mjs";

/** Squares along a side of a sheet: 51,200 triangles, of which there is a tree. */
const CELLS = 160;
/** Rays of which the hits are compared. */
const RAYS = 200;

let random = 1;
/** A number of a known sequence, from -1 to 1. */
const next = () => {
  random = (random * 48271) % 2147483647;
  return (2 * random) / 2147483647 - 1;
};

/** Sheets above each other, each `CELLS` squares along a side. */
function sheets(...heights) {
  const positions = [];
  const indices = [];
  for (const [sheet, height] of heights.entries()) {
    const first = sheet * (CELLS + 1) ** 2;
    for (let i = 0; i <= CELLS; i++) {
      for (let j = 0; j <= CELLS; j++) {
        const [x, y] = [i, j].map((index) => (2 * index) / CELLS - 1);
        positions.push(x, y, height);
        if (i === CELLS || j === CELLS) continue;
        const corner = first + i * (CELLS + 1) + j;
        const [right, far] = [corner + CELLS + 1, corner + CELLS + 2];
        indices.push(corner, right, far, corner, far, corner + 1);
      }
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}

// The worker's code in this thread, with copies of what is posted.
let posted;
globalThis.self = { postMessage: (data) => (posted = structuredClone(data)) };
await moduleOf("scene/picking/treeWorker.ts");
let answer;
globalThis.Worker = class {
  postMessage(data) {
    self.onmessage({ data: structuredClone(data) });
    answer = () => this.onmessage({ data: posted });
  }
  terminate() {}
};

/** Gives the tree that was asked for, once it was. */
async function built() {
  while (answer === undefined) await new Promise((resolve) => setTimeout(resolve, 50));
  answer();
  answer = undefined;
}

test("a tree hits what is hit one by one, where vertices were moved too", async () => {
  const { TriangleHits } = await moduleOf("scene/picking/triangleHits.ts");
  const triangles = sheets(0, 0.3);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(triangles.positions, 3));
  geometry.setIndex(new BufferAttribute(triangles.indices, 1));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ side: DoubleSide }));
  mesh.matrixWorld.makeRotationX(0.4).setPosition(0.1, 0.2, 0.3);
  const tree = new TriangleHits(mesh, triangles);
  const rays = Array.from({ length: RAYS }, () => {
    const from = new Vector3(next(), next(), 3);
    return new Raycaster(from, new Vector3(next(), next(), 0).sub(from).normalize());
  });
  const compare = () => {
    let count = 0;
    for (const ray of rays) {
      const expected = [];
      Mesh.prototype.raycast.call(mesh, ray, expected);
      const found = [];
      mesh.raycast(ray, found);
      const all = [found, expected].map((hits) =>
        hits
          .map(({ faceIndex, face, distance }) => [faceIndex, face.a, distance.toFixed(9)])
          .sort((one, other) => one[0] - other[0]),
      );
      assert.deepEqual(all[0], all[1]);
      count += expected.length;
    }
    assert.ok(count > RAYS / 2, `${count}`);
  };
  compare();
  await built();
  compare();
  // The upper sheet goes far up, in place.
  for (let at = triangles.positions.length / 2 + 2; at < triangles.positions.length; at += 3) {
    triangles.positions[at] = 1.2;
  }
  geometry.boundingSphere = null;
  tree.moved();
  compare();
});

test("of a cloud the point in front of those under the pointer is hit, by a tree too", async () => {
  const { PointHits } = await moduleOf("scene/picking/pointHits.ts");
  const count = 60_000;
  const positions = Float32Array.from({ length: 3 * count }, next);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  const points = new Points(geometry, new PointsMaterial());
  points.matrixWorld
    .makeRotationX(0.4)
    .scale(new Vector3(2, 2, 2))
    .setPosition(0.1, 0.2, 0.3);
  const [eye, flat] = [new PerspectiveCamera(32), new OrthographicCamera(-3, 3, 3, -3, 0.1, 20)];
  for (const camera of [eye, flat]) {
    camera.position.set(1, 2, 9);
    camera.lookAt(0, 0, 0);
    camera.updateMatrixWorld();
  }
  const rays = Array.from({ length: RAYS }, (_, index) => {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(next() / 3, next() / 3), index % 2 ? eye : flat);
    ray.params.Points.threshold = index % 2 ? 0.004 : 0.03;
    return ray;
  });
  new PointHits(points, positions);
  /** The point in front of all whose discs a ray hits, by their definition. */
  const expected = ({ ray, params, camera }) => {
    let [best, least] = [undefined, Number.POSITIVE_INFINITY];
    const planes = points.material.clippingPlanes ?? [];
    const at = new Vector3();
    for (let index = 0; index < count; index++) {
      at.fromArray(positions, 3 * index).applyMatrix4(points.matrixWorld);
      const depth = at.clone().sub(ray.origin).dot(ray.direction);
      const radius = params.Points.threshold * (camera === eye ? depth : 1);
      const isHit = depth > 0 && ray.distanceToPoint(at) <= radius;
      if (!isHit || depth >= least || planes.some((plane) => plane.distanceToPoint(at) < 0))
        continue;
      [best, least] = [index, depth];
    }
    return best;
  };
  const compare = () => {
    let found = 0;
    for (const ray of rays) {
      const hits = [];
      points.raycast(ray, hits);
      const best = expected(ray);
      assert.deepEqual(
        hits.map(({ index }) => index),
        best === undefined ? [] : [best],
      );
      if (best === undefined) continue;
      found += 1;
      const at = new Vector3().fromArray(positions, 3 * best).applyMatrix4(points.matrixWorld);
      assert.ok(at.distanceTo(new Vector3().copy(hits[0].point)) < 1e-9);
    }
    assert.ok(found > RAYS / 2, `${found}`);
  };
  compare();
  await built();
  compare();
  points.material.clippingPlanes = [new Plane(new Vector3(0, 0, -1), 0.2)];
  compare();
});

let opened;
let page;

before(async () => {
  opened = await open({ path: PLAIN });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** An OBJ file of sheets, each a group of its own. */
function groups(name, ...heights) {
  const { positions, indices } = sheets(...heights);
  const lines = [];
  for (let at = 0; at < positions.length; at += 3) {
    lines.push(`v ${positions.slice(at, at + 3).join(" ")}`);
  }
  for (let at = 0; at < indices.length; at += 3) {
    const sheet = Math.floor((at * heights.length) / indices.length);
    if (at % (indices.length / heights.length) === 0) lines.push(`g sheet${sheet}`);
    lines.push(`f ${[...indices.slice(at, at + 3)].map((corner) => corner + 1).join(" ")}`);
  }
  return file(name, lines.join("\n"));
}

test("a click on many triangles finds what is drawn there, and below what is hidden", async () => {
  await opened.until("done", () => page.setInputFiles("#file-a", groups("a.obj", 0, 0.5)));
  await opened.until("done", () => page.setInputFiles("#file-b", groups("b.obj", -0.25)));
  await page.selectOption("#show-b", "hidden");
  await page.waitForFunction(() => performance.getEntriesByName("tree of a model").length >= 2);
  await page.selectOption("#direction", "top");
  await drawn(page);
  const pinned = async () => {
    const count = await page.locator(".pin").count();
    await page.locator("#canvas").focus();
    await page.keyboard.press("Enter");
    const pin = page.locator(".pin").nth(count);
    await pin.waitFor();
    return pin.textContent();
  };
  assert.match(await pinned(), /0\.750/);
  await page.locator("#tree-list .face input[type=checkbox]").nth(1).uncheck();
  await drawn(page);
  assert.match(await pinned(), /0\.250/);
});

test("a click on a cloud finds the point that is seen there, however small the cloud is", async () => {
  // Nine points, of which the middle one is farther from B than the others, within a thousandth of a unit.
  const point = (i, j, z) => `${i * 4e-4} ${j * 4e-4} ${z}`;
  const places = [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => [i, j]));
  const cloud = (heightOf) => places.map(([i, j]) => point(i, j, heightOf(i, j))).join("\n");
  const [a, b] = [cloud((i, j) => (i === 0 && j === 0 ? 1e-4 : 3e-4)), cloud(() => 0)];
  await opened.until("done", () => page.setInputFiles("#file-a", file("a.xyz", a)));
  await opened.until("done", () => page.setInputFiles("#file-b", file("b.xyz", b)));
  await page.selectOption("#direction", "top");
  await drawn(page);
  const count = await page.locator(".pin").count();
  await page.locator("#canvas").focus();
  await page.keyboard.press("Enter");
  const pin = page.locator(".pin").nth(count);
  await pin.waitFor();
  // A point is named by its number, and has no parameters.
  assert.match(await pin.textContent(), /0\.000100*A point 4foot on B point 4:/);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
