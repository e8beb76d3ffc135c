// Signs and colours of solids on the page: inside is negative and blue, outside positive and red.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { cube, cylinder, modelFile, tetrahedron } from "./support/models.mjs";
import { open } from "./support/open.mjs";

let opened;

before(async () => {
  opened = await open();
  await opened.page.locator('#result[data-state="done"]').waitFor();
  await opened.until("done", () => opened.page.locator("#symmetric").check());
  await opened.until("done", () => opened.page.locator("#deviation").check());
});

after(() => opened.close());

async function openPair(a, b) {
  for (const [side, model] of Object.entries({ a, b })) {
    await opened.until("done", () =>
      opened.page.setInputFiles(`#file-${side}`, modelFile(`${side}.json`, model)),
    );
  }
}

/** The file that a button exports. */
async function exported(id) {
  const [download] = await Promise.all([
    opened.page.waitForEvent("download"),
    opened.page.locator(id).click(),
  ]);
  return readFileSync(await download.path());
}

/** The vertices of both models' maps, each with its distance and its signed deviation. */
async function vertices() {
  const [, ...lines] = (await exported("#export-csv")).toString().trim().split("\n");
  return lines.map((line) => {
    const [side, , ...numbers] = line.split(",");
    const [x, y, z, , , , distance, signed] = numbers.map((text) =>
      text === "" ? Number.NaN : Number(text),
    );
    return { side, point: [x, y, z], distance, signed };
  });
}

/** The red and the blue of every vertex of a model, linear. */
async function colours(side) {
  const gltf = await exported("#export-gltf");
  const { scene } = await new GLTFLoader().parseAsync(new Uint8Array(gltf).buffer, "");
  const mesh = scene.getObjectByName(side);
  const { color } = mesh.geometry.attributes;
  return Array.from({ length: color.count }, (_, index) => [color.getX(index), color.getZ(index)]);
}

test("a tetrahedron in a body is inside, and the body outside of it", async () => {
  // The feet of most points of the body are edges and corners of the tetrahedron.
  await openPair(tetrahedron(1), cube(2));
  const all = await vertices();
  for (const { side, point, distance, signed } of all) {
    const expected = side === "A" ? -distance : distance;
    assert.ok(Math.abs(signed - expected) < 1e-12, `${side} ${point}: ${signed} for ${expected}`);
    // The nearest face of the cube is as far from a point within it as its largest coordinate says.
    if (side === "A") {
      const depth = 2 - Math.max(...point.map(Math.abs));
      // The map permits an excess of 5e-8 of the diagonal.
      const excess = distance - depth;
      assert.ok(-1e-9 < excess && excess < 5e-8 * Math.hypot(4, 4, 4), `${distance} at ${point}`);
    }
  }
  for (const side of ["A", "B"]) {
    assert.ok(all.filter((vertex) => vertex.side === side).length > 100, side);
    for (const [red, blue] of await colours(side)) {
      assert.ok(side === "A" ? blue > red : red > blue, `${side}: ${red} and ${blue}`);
    }
  }
  await opened.screenshot("tetrahedron-in-a-cube");
});

test("a cylinder against its bored copy has material over the bore outside, and the bore inside", async () => {
  await openPair(cylinder({ bored: false }), cylinder({ bored: true }));
  const counts = { A: 0, B: 0 };
  for (const { side, point, signed } of await vertices()) {
    const [radius, height] = [Math.hypot(point[0], point[1]), Math.abs(point[2])];
    // Over the bore the rim is nearest; of the bore's wall the nearer end or the outer wall.
    const expected =
      side === "A" ? Math.max(0, 1 - radius) : radius < 1.5 ? Math.max(radius - 2, height - 1) : 0;
    assert.ok(Math.abs(signed - expected) < 1e-6, `${side} ${point}: ${signed} for ${expected}`);
    if (Math.abs(expected) > 1e-3) counts[side] += 1;
  }
  assert.ok(counts.A > 10 && counts.B > 10, JSON.stringify(counts));
  for (const side of ["A", "B"]) {
    const coloured = (await colours(side)).filter(([red, blue]) => Math.abs(red - blue) > 0.1);
    assert.ok(coloured.length > 10, `${side}: ${coloured.length}`);
    for (const [red, blue] of coloured) assert.ok(side === "A" ? red > blue : blue > red, side);
  }
  await opened.screenshot("bored-cylinder");
});

test("a clash is shown as one", async () => {
  const { page } = opened;
  await openPair(cube(1), cube(1.5));
  await opened.until("done", () => page.locator("#move-x-exact").fill("2"));
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-meeting="clash"]').waitFor();
  await opened.screenshot("clash");
  // By how much is the next question.
  assert.ok(await page.getByText("How deep they clash").isVisible());
  await page.locator("#clearance-start").click();
});

test("a report has the clearance and the faces that come near, while they are shown", async () => {
  const { page } = opened;
  // Cubes of ±1 about 4 and of ±1.5.
  await opened.until("done", () => page.locator("#move-x-exact").fill("4"));
  const report = async () => (await exported("#export-report")).toString();
  assert.ok(!(await report()).includes("Clearance and clash"));
  await page.locator("#below").fill("2");
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-meeting="apart"]').waitFor();
  assert.ok(await page.locator("#clash-depth").isHidden());
  const made = await report();
  // The first thing said is what is measured, not that there is no verdict on a deviation.
  assert.match(made, /class="badge">APART<\/span>Apart by 1\.5/);
  assert.ok(!made.includes("NO VERDICT") && !made.includes("symmetric"), made.slice(0, 2000));
  const { clearance } = JSON.parse((await exported("#export-json")).toString());
  assert.ok(clearance.clearance.lower <= 1.5 && 1.5 <= clearance.clearance.upper);
  const [, table] = made.split("Clearance and clash");
  const intervals = [...table.split("</table>")[0].matchAll(/\[([\d.e-]+), ([\d.e-]+)\]<\/td>/g)];
  assert.ok(intervals.length > 1, table);
  // Faces that face each other, and those beside one or both of them.
  const expected = [1.5, Math.hypot(1.5, 0.5), Math.hypot(1.5, 0.5, 0.5)];
  for (const [index, [, lower, upper]] of intervals.entries()) {
    const [least, most] = [Number(lower), Number(upper)];
    const held = expected.slice(0, index === 0 ? 1 : undefined);
    assert.ok(
      held.some((at) => least <= at && at <= most) && most - least < 0.01,
      `${lower}, ${upper}`,
    );
  }
  await page.locator("#clearance-start").click();
  assert.ok(!(await report()).includes("Clearance and clash"));
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
