// What lies over the view: not over the models, nor cut off at the view's edges.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { open } from "../support/open.mjs";
import { countEach, countPixels } from "../support/pixels.mjs";

const SCREENS = {
  desktop: { width: 1280, height: 800 },
  tablet: { width: 820, height: 1180 },
  "tablet on its side": { width: 1180, height: 820 },
  telephone: { width: 390, height: 844 },
};
const BROKEN = { name: "cut.step", mimeType: "text/plain", buffer: Buffer.from("ISO-10303-21;\n") };
/** The colours of maps, and not those of the view's background. */
const COLOURED = "Math.max(r, g, b) - Math.min(r, g, b) > 40";

let opened;
let page;

before(async () => {
  opened = await open({ path: "", unfolded: false });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** Asserts that these elements are shown, and nothing of the models beneath them. */
async function keepsClear(screen, ...selectors) {
  for (const selector of selectors) {
    assert.ok(await page.locator(selector).isVisible(), `${screen}: ${selector}`);
  }
  const [all, ...beneath] = await countEach(page, COLOURED, ["#canvas", ...selectors]);
  assert.deepEqual(beneath, Array(selectors.length).fill(0), `${screen}: ${selectors}`);
  assert.ok(all > 10_000, screen);
}

for (const [screen, size] of Object.entries(SCREENS)) {
  test(`on a ${screen} nothing lies over the models`, async () => {
    await page.setViewportSize(size);
    // A section leaves the half that is seen from where the camera is then.
    for (const view of ["top", "bottom", "oblique"]) {
      await page.selectOption("#direction", view);
      await keepsClear(`${screen}, ${view}`, "#legend");
    }
    await page.selectOption("#section-axis", "1");
    await page.locator("#cut svg").waitFor();
    for (const view of ["back", "isometric"]) {
      await page.selectOption("#direction", view);
      await keepsClear(`${screen}, ${view}`, "#legend", "#cut", "#context");
    }
    // Nor is a control covered by the plot.
    const [plot, context] = await Promise.all(
      ["#cut", "#context"].map((selector) => page.locator(selector).boundingBox()),
    );
    assert.ok(context.y + context.height <= plot.y, screen);
    await opened.screenshot(`clear-${screen.replaceAll(" ", "-")}`);
    await page.selectOption("#section-axis", "");
  });
}

test("side by side nothing lies over either model", async () => {
  const all = { ...SCREENS, "telephone on its side": { width: 844, height: 390 } };
  for (const [screen, size] of Object.entries(all)) {
    await page.setViewportSize(size);
    for (const id of ["#wipe", "#beside"]) await page.locator(id).setChecked(true, { force: true });
    await page.selectOption("#direction", "oblique");
    await keepsClear(`${screen}, side by side`, "#legend");
    if (screen === "desktop") await opened.screenshot("clear-beside");
    await page.locator("#wipe").setChecked(false, { force: true });
  }
});

test("labels of the arrow are within the view, wherever its ends are", async () => {
  await page.setViewportSize(SCREENS.desktop);
  const rows = page.locator("#place-list button");
  for (const place of [0, 1, 2, 3]) {
    await rows.nth(place).click();
    await page.locator("#label", { hasText: "0.350" }).waitFor();
    for (const view of ["oblique", "isometric", "left", "back", "top"]) {
      await page.selectOption("#direction", view);
      await drawn(page);
      const outside = await page.evaluate(() => {
        const { left, right } = document.getElementById("stage").getBoundingClientRect();
        const labels = [...document.querySelectorAll("#label, .end")];
        return labels
          .filter((label) => label.checkVisibility())
          .map((label) => label.getBoundingClientRect())
          .filter((box) => box.left < left - 1 || box.right > right + 1).length;
      });
      assert.equal(outside, 0, `${place}, ${view}`);
    }
  }
});

test("an arrow that is seen head-on names both its ends", async () => {
  // The witnesses of the brackets are apart along x.
  await page.selectOption("#direction", "oblique");
  await page.locator("#place-list button").first().click();
  await page.locator("#approach").click();
  await page.selectOption("#direction", "right");
  assert.equal(await page.locator("#label").getAttribute("data-ends"), "", "it is short from far");
  await page.locator("#approach").click();
  await page.waitForFunction(() => document.getElementById("label").dataset.ends !== "");
  const ends = await page.locator("#label").getAttribute("data-ends");
  assert.match(ends, /^A: base end → B: base (end|top|bottom)$/);
  await opened.screenshot("head-on");
});

test("the legend leads to its controls", async () => {
  await page.locator("#legend-controls").click();
  assert.ok(await page.locator("#scale-steps").isVisible());
  assert.equal(await page.evaluate(() => document.activeElement.id), "scale-map");
});

test("Escape shows what was seen before places were shown from near", async () => {
  await page.selectOption("#direction", "left");
  // The arrow of a place stays, and is not compared.
  const seen = async () => {
    await drawn(page);
    return page.locator("#axes").innerHTML();
  };
  const before = [await seen(), await countPixels(page, COLOURED)];
  await page.locator("#canvas").focus();
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  assert.notDeepEqual([await seen(), await countPixels(page, COLOURED)], before);
  await page.keyboard.press("Escape");
  const [cube, count] = [await seen(), await countPixels(page, COLOURED)];
  assert.equal(cube, before[0]);
  assert.ok(Math.abs(count - before[1]) < 0.02 * before[1], `${count} for ${before[1]}`);
});

test("a comparison of faces says what its colours are, without the legend of the map", async () => {
  assert.ok(await page.locator("#legend").isVisible());
  await page.locator("#compare").click();
  await page.locator('#faces[data-state="done"]').waitFor();
  assert.ok(await page.locator("#legend").isHidden());
  assert.match(await page.locator("#face-summary").textContent(), /the colour of their model/);
  await page.locator("#faces-clear").click();
  assert.ok(await page.locator("#legend").isVisible());
});

test("what is allowed of a face, and of all, is read whole in the narrow tree", async () => {
  for (const width of [1250, 1110]) {
    await page.setViewportSize({ width, height: 700 });
    await page.locator("#tree-list .face").first().hover();
    const own = page.locator("#tree-list .own-limit").first();
    await own.fill("+0.2125/-0.10625");
    await page.locator("#face-limit").fill("0.000123456");
    for (const field of [own, page.locator("#face-limit")]) {
      const isWhole = await field.evaluate((input) => {
        const { left, right } = input.getBoundingClientRect();
        const side = document.getElementById("side").getBoundingClientRect();
        const isWithin = left >= side.left && right <= side.right;
        return isWithin && input.scrollWidth <= input.clientWidth;
      });
      assert.ok(isWhole, `${width}`);
    }
    await own.fill("");
  }
  await page.locator("#face-limit").fill("0.2");
});

test("an error lies over the models on no screen", async () => {
  await page.selectOption("#direction", "isometric");
  await page.setInputFiles("#file-a", BROKEN);
  await page.locator("#error").waitFor();
  for (const [screen, size] of Object.entries(SCREENS)) {
    await page.setViewportSize(size);
    await keepsClear(screen, "#legend", "#error");
  }
});

test("the keyboard picks what is nearest to the middle, from each side", async () => {
  // From some sides nothing of a bracket is in the middle of its box, nor in that of the view.
  await page.setViewportSize(SCREENS.desktop);
  await opened.until("done", () => page.selectOption("#preset", { index: 0 }));
  for (const view of ["oblique", "front", "top", "left"]) {
    await page.selectOption("#direction", view);
    await drawn(page);
    await page.locator("#canvas").focus();
    await page.keyboard.press("k");
    await page.keyboard.press("Enter");
    assert.equal(await page.locator("#annotations textarea").count(), 1, view);
    await page.keyboard.press("Escape");
  }
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
