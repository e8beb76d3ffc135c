// What the view and the lists show: nothing that the certified numbers beside them contradict.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { box } from "../support/boxes.mjs";
import { drawn } from "../support/drawn.mjs";
import { cube, file, modelFile, planes, row } from "../support/models.mjs";
import { open } from "../support/open.mjs";
import { countPixels } from "../support/pixels.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: "" });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();

/** Opens two files as A and B. */
const openPair = (a, b) => opened.until("done", () => page.setInputFiles("#file-both", [a, b]));

/** Whether a pixel is this colour of the style, to what drawing rounds. */
const near = (...rgb) =>
  ["r", "g", "b"].map((name, at) => `Math.abs(${name} - ${rgb[at]}) < 4`).join(" && ");
/** The green of what is allowed, as in the legend, and the two greys of a cut. */
const GREEN = near(0x79, 0xb9, 0x8a);
const CUT = near(0xcd, 0xd3, 0xd9);
const BLUE = "b > 110 && b > 1.5 * r && b > 1.3 * g";

test("colours that face the eye are those of the legend, and darker by a third at most", async () => {
  await openPair(modelFile("a.json", planes(0)), modelFile("b.json", planes(0.01)));
  await page.locator("#limit").fill("0.2");
  await page.locator("#orthographic").check();
  await page.selectOption("#direction", "top");
  const facing = await countPixels(page, GREEN);
  assert.ok(facing > 20_000, `${facing} pixels`);
  await page.selectOption("#direction", "oblique");
  // Between 65 % and the whole of each part of the green.
  const shaded = [0x79, 0xb9, 0x8a]
    .map((part, at) => `${"rgb"[at]} <= ${part + 3} && ${"rgb"[at]} >= ${0.65 * part - 3}`)
    .join(" && ");
  const oblique = await countPixels(page, `${shaded} && g > 1.2 * b`);
  assert.ok(oblique > 10_000, `${oblique} pixels`);
  await page.locator("#orthographic").uncheck();
});

test("what agrees has one colour on both models, and no arrow", async () => {
  await openPair(modelFile("a.json", cube(1)), modelFile("b.json", cube(1)));
  await page.locator("#limit").fill("0.2");
  for (const painted of ["a", "b"]) {
    await opened.until("done", () => page.selectOption("#paint", painted));
    await page.selectOption("#direction", "front");
    const green = await countPixels(page, GREEN);
    assert.ok(green > 20_000, `${painted}: ${green}`);
  }
  assert.ok(await page.locator("#label").isHidden());
  assert.match(await text("#where"), /agree/);
  await opened.until("done", () => page.selectOption("#paint", "both"));
});

test("a cut is hatched in grey, towards the user, from whichever side", async () => {
  await page.selectOption("#show-b", "hidden");
  for (const view of ["oblique", "isometric", "back", "left"]) {
    await page.selectOption("#direction", view);
    const along = { oblique: 0, isometric: 0, back: 1, left: 0 }[view];
    await page.selectOption("#section-axis", `${along}`);
    const [cut, blue] = [await countPixels(page, CUT), await countPixels(page, BLUE)];
    assert.ok(cut > 3000, `${view}: ${cut} pixels of the cut`);
    assert.equal(blue, 0, `${view}: the blue of a deviation`);
    if (view === "isometric") await opened.screenshot("cut");
    await page.selectOption("#section-axis", "");
  }
  await page.selectOption("#show-b", "auto");
});

test("one way, faces of B are neither listed nor beyond what is allowed", async () => {
  // All of A is on B, and one of B's squares is 0.5 from A.
  await openPair(modelFile("a.json", row(0)), modelFile("b.json", row(0, 0.5)));
  await page.locator("#limit").fill("0.2");
  await page.waitForSelector('#points[data-bounded="0.2"]');
  assert.equal(await text("#badge"), "FAIL");
  assert.ok((await page.locator("#place-list button:has(b.b)").count()) > 0);
  await opened.until("done", () => page.locator("#symmetric").uncheck());
  await page.waitForSelector('#points[data-bounded="0.2"]');
  assert.equal(await text("#badge"), "PASS");
  assert.equal(await page.locator("#place-list button:has(b.a)").count(), 1);
  assert.equal(await page.locator("#place-list button:has(b.b)").count(), 0);
  assert.equal(await page.locator('#tree-list [data-changed="true"]').count(), 0);
  await opened.until("done", () => page.locator("#symmetric").check());
});

test("faces are listed and judged by what is certain of them", async () => {
  // Of a sphere's quarter the middles of edges are off the surface: the map alone overshoots.
  const { sphereParts } = await import("../support/models.mjs");
  await openPair(modelFile("a.json", sphereParts.a), modelFile("b.json", sphereParts.b));
  await page.locator("#limit").fill("0.2001");
  await page.locator('#points[data-bounded="0.2001"]').waitFor();
  const size = await text("#place-list button:has(b.a) .size");
  assert.ok(Math.abs(Math.abs(Number(size.replace("−", "-").replace("…", ""))) - 0.2) < 2e-4, size);
  await page.locator("#compare").click();
  await page.locator('#faces[data-state="done"]').waitFor();
  const changed = await page
    .locator('#face-list button[data-side="a"][data-state="changed"]')
    .count();
  const beyond = await page
    .locator('#place-list button:has(b.a) .size[data-allowed="beyond"]')
    .count();
  assert.equal(beyond, changed);
  await page.locator("#faces-clear").click();
});

test("a face whose interval contains what is allowed is neither within nor beyond", async () => {
  await openPair(modelFile("a.json", planes(0)), modelFile("b.json", planes(0.3)));
  await page.locator("#limit").fill("0.3");
  await page.locator('#points[data-bounded="0.3"]').waitFor();
  assert.equal(await text("#badge"), "UNDECIDED");
  const sizes = page.locator("#place-list .size");
  assert.equal(await sizes.count(), 2);
  assert.equal(await page.locator('#place-list .size[data-allowed="undecided"]').count(), 2);
  assert.equal(await page.locator('#tree-list [data-changed="true"]').count(), 0);
  const [report] = await Promise.all([
    page.waitForEvent("popup"),
    page.locator("#export-pages").click(),
  ]);
  const rows = report.locator("tr", { hasText: "undecided" });
  await rows.first().waitFor();
  assert.equal(await rows.count(), 2);
  await report.close();
});

test("a place is looked at from outside of its model, whichever way the normals of its file point", async () => {
  const block = (name, low, turned) => {
    const { surfaces, ...rest } = { surfaces: box("block", [0, 0, low], [4, 3, 2]) };
    const inwards = surfaces.map(({ ctrl, ...face }) => ({ ...face, ctrl: [...ctrl].reverse() }));
    return modelFile(name, { ...rest, surfaces: turned ? inwards : surfaces });
  };
  for (const turned of [false, true]) {
    // The lower faces are 0.5 apart, all others lie on each other.
    await openPair(block("a.json", 0, turned), block("b.json", -0.5, turned));
    await page.locator("#place-list button").first().click();
    // The cube of views shows the sides that face the user.
    await page.locator("#axes").getByText("bottom").waitFor({ timeout: 20_000 });
  }
});

test("faces are compared one model at a time, and again by another limit", async () => {
  await openPair(modelFile("a.json", row(0, 0)), modelFile("b.json", row(0, 0.5)));
  await page.locator("#limit").fill("0.1");
  await page.locator("#compare").click();
  await page.locator('#faces[data-state="done"] #face-list button').first().waitFor();
  const side = await page.locator("#faces-side").inputValue();
  assert.ok(side === "a" || side === "b", side);
  // Each model has its own colour on its own.
  const count = async (shown) => {
    await page.selectOption("#faces-side", shown);
    return [await countPixels(page, BLUE), await countPixels(page, "r > 1.3 * g && g > 1.5 * b")];
  };
  const [blueOfA, orangeOfA] = await count("a");
  const [blueOfB, orangeOfB] = await count("b");
  assert.ok(blueOfA > 2000 && orangeOfA < 500, `A: ${blueOfA}, ${orangeOfA}`);
  assert.ok(orangeOfB > 2000 && blueOfB < 500, `B: ${blueOfB}, ${orangeOfB}`);
  await page.locator("#limit").fill("0.6");
  await page.locator("#face-summary", { hasText: "No face differs by more than 0.6" }).waitFor();
  assert.equal(await page.locator("#face-list button").count(), 0);
  await page.locator("#faces-clear").click();
});

test("a clearance shows both models in their colours, follows A, and is ended from the card", async () => {
  await openPair(modelFile("a.json", cube(1)), modelFile("b.json", cube(1)));
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-state="done"]').waitFor();
  await page.locator("#move-x-exact").fill("40");
  await page.locator("#clearance-text", { hasText: "Apart by 38" }).waitFor();
  await drawn(page);
  const orange = await countPixels(page, "r > 1.2 * g && g > 1.3 * b");
  const blue = await countPixels(page, "b > 1.3 * r && b > 1.1 * g");
  assert.ok(blue > 300 && orange > 300, `blue ${blue}, orange ${orange}`);
  await opened.screenshot("clearance-moved");
  await page.locator("#clearance-details > summary").click();
  assert.ok(await page.locator("#clearance-start").isHidden());
  await opened.until("done", () => page.locator("#clearance-end").click());
  assert.ok(await page.locator("#clearance-end").isHidden());
  await opened.until("done", () => page.locator("#move-x-exact").fill("0"));
});

test("a clearance is stated with the gaps of the files", async () => {
  const withGap = {
    ...planes(0),
    surfaces: planes(0).surfaces.map((one) => ({ ...one, gap: 0.03 })),
  };
  await openPair(modelFile("a.json", withGap), modelFile("b.json", planes(17)));
  await page.evaluate(() => {
    document.getElementById("clearance-details").open = true;
  });
  await page.locator("#clearance-start").click();
  await page.locator("#clearance-text", { hasText: "Apart by 17" }).waitFor();
  const [, low, high] = /gaps of the files in \[([\d.]+), ([\d.]+)\]/.exec(
    await text("#clearance-text"),
  );
  assert.ok(Number(low) <= 16.97 && Number(high) >= 17.03, `${low} ${high}`);
  assert.ok(Number(low) > 16.96 && Number(high) < 17.04, `${low} ${high}`);
  await opened.until("done", () => page.locator("#clearance-end").click());
});

test("against a scan the models keep the signs that are known", async () => {
  const points = ["0 0 1.25", "0.5 0 1.25", "0 0.5 1.25", "0 0 0.5"].join("\n");
  await openPair(file("scan.xyz", points), modelFile("solid.json", cube(1)));
  await page.locator("#limit").fill("0.1");
  // The points have signs, as the cube closes; the cube has none, as points have no inside.
  assert.match(await text("#legend-title"), /^Signed deviation of A.*B’s has no sign/);
  const statistics = await opened.texts("#statistics");
  assert.equal(statistics["A: negative"], "inside the solid B");
  assert.equal(statistics["B: signed mean"], undefined);
  assert.match(statistics["B: signs"], /A has no inside/);
  assert.match(await text("#note-a"), /points · 4 points · unit unknown/);
  assert.match(await text("#place-list button:has(b.a)"), /all of it/);
  assert.match(await text("#where"), /point \d/);
  await opened.screenshot("scan-and-solid");
});

test("of points the page says that both ways judge the surface between them too", async () => {
  assert.match(await text("#scan-note"), /^A is points: both ways also judge how far B is/);
  await page.locator("#symmetric").uncheck();
  assert.ok(await page.locator("#scan-note").isHidden());
  await openPair(modelFile("solid.json", cube(1)), file("scan.xyz", "0 0 1.25"));
  assert.match(await text("#scan-note"), /^B is points: one way judges how far A is/);
  await page.locator("#symmetric").check();
  await openPair(file("one.xyz", "0 0 1"), file("two.xyz", "0 0 1.25"));
  assert.ok(await page.locator("#scan-note").isHidden());
});

test("a dense scan has the colours of the legend: its points hide each other's rims", async () => {
  // Points two pixels apart and less, on a sheet that is tilted by 45 degrees.
  const side = 200;
  const points = Array.from({ length: side * side }, (_, index) => {
    const [i, j] = [Math.floor(index / side), index % side].map((at) => (2 * at) / side - 1);
    return `${i} ${j} ${j + 0.01}`;
  });
  const tilted = {
    surfaces: planes(0).surfaces.map((surface) => ({
      ...surface,
      ctrl: surface.ctrl.map((row) => row.map(([x, y, z, w]) => [x, y, z + y, w])),
    })),
  };
  await openPair(file("scan.xyz", points.join("\n")), modelFile("sheet.json", tilted));
  await page.locator("#limit").fill("0.2");
  await page.selectOption("#show-b", "hidden");
  for (const isFlat of [false, true]) {
    await page.locator("#orthographic").setChecked(isFlat);
    for (const view of ["top", "front"]) {
      await page.selectOption("#direction", view);
      const [green, dark] = [
        await countPixels(page, GREEN),
        await countPixels(page, "r + g + b < 120"),
      ];
      assert.ok(green > 20_000, `${view}: ${green} pixels of the legend's green`);
      // Those of the outline are dark.
      assert.ok(dark < 0.1 * green, `${view}: ${dark} dark pixels beside ${green}`);
    }
  }
  await page.locator("#orthographic").uncheck();
  await page.selectOption("#show-b", "auto");
  await page.locator("#limit").fill("");
});

/** A box from 0 to these sizes as STL. */
function stlBox(name, [x, y, z]) {
  const corner = (index) => [index & 1 ? x : 0, index & 2 ? y : 0, index & 4 ? z : 0];
  const quads = ["0264", "1573", "0451", "2376", "0132", "4675"];
  const facets = quads.flatMap((quad) => {
    const [a, b, c, d] = [...quad].map((index) => corner(Number(index)));
    return [
      [a, b, c],
      [a, c, d],
    ];
  });
  const lines = facets.map(
    (corners) =>
      `facet normal 0 0 0\nouter loop\n${corners.map((at) => `vertex ${at.join(" ")}`).join("\n")}\nendloop\nendfacet\n`,
  );
  return file(name, `solid box\n${lines.join("")}endsolid box\n`);
}

test("a mesh has a note and creases, and its unit is asked for and converted", async () => {
  await page.locator("#limit").fill("");
  const inches = stlBox("inches.stl", [3, 3, 3]);
  await openPair(modelFile("mm.json", { ...cube(38.1), unit: 0.001 }), inches);
  assert.match(await text("#note-b"), /mesh · 12 triangles · unit unknown/);
  assert.match(await text("#units-differ"), /B states no unit/);
  assert.match(await text("#units-differ"), /inches and millimetres/);
  assert.equal(await text("#unit"), "model units");
  await opened.until("done", () => page.selectOption("#unit-b", "0.0254"));
  assert.equal(await text("#unit"), "mm");
  assert.match(await text("#units-differ"), /B is converted to mm/);
  assert.match(await text("#where"), /triangle \d/);
  await page.selectOption("#show-a", "hidden");
  await opened.until("done", () => page.locator("#deviation").uncheck());
  // The creases of the box, dark lines on its own colour.
  const dark = await countPixels(page, "r < 110 && g < 90 && b < 80");
  assert.ok(dark > 300, `${dark} dark pixels`);
  await opened.screenshot("mesh-creases");
  await page.selectOption("#show-a", "auto");
});

test("the page says when the view's context is lost, and no longer when it is there again", async () => {
  const lost = page.locator("#banner", { hasText: "took its 3D context away" });
  await page.evaluate(() => {
    const context = document.getElementById("canvas").getContext("webgl2");
    window.lost = context.getExtension("WEBGL_lose_context");
    window.lost.loseContext();
  });
  await lost.waitFor();
  await page.evaluate(() => window.lost.restoreContext());
  await lost.waitFor({ state: "hidden" });
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
