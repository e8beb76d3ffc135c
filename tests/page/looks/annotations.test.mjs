// Texts at points of the models: written with mouse and keyboard, in the list, the link, the report, undone.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { modelFile, planes } from "../support/models.mjs";
import { moduleOf } from "../support/module.mjs";
import { open, PLAIN } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: PLAIN });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
  for (const [side, height] of [
    ["a", 0],
    ["b", 0.25],
  ]) {
    const file = modelFile(`${side}.json`, planes(height));
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, file));
  }
  await page.selectOption("#direction", "top");
  await drawn(page);
});

after(() => opened.close());

const labels = () => page.locator("#annotations button.annotation");
const field = () => page.locator("#annotations textarea");

/** Clicks on the view at parts of its width and height. */
async function click(across, down) {
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await page.mouse.click(x + across * width, y + down * height);
}

test("a text is written at a point that is clicked, with a line from there to it", async () => {
  await page.locator("#annotate").click();
  await click(0.55, 0.55);
  await field().fill("scratched here");
  await field().press("Enter");
  await drawn(page);
  assert.deepEqual(await labels().allTextContents(), ["1scratched here"]);
  assert.equal(await page.locator("#annotation-list li").count(), 1);
  assert.equal(await page.locator(".pin").count(), 0);
  // The line begins where the click was; what was said above the view may have made room since.
  const line = await page.locator("#annotations path").getAttribute("d");
  const [, x, y] = /0M(\S+) (\S+)L/.exec(line).map(Number);
  const { width, height } = await page.locator("#canvas").boundingBox();
  assert.ok(Math.abs(x - 0.55 * width) < 2, `${x} of ${width}`);
  assert.ok(Math.abs(y - 0.55 * height) < 40, `${y} of ${height}`);
});

test("the keyboard alone puts, changes and removes a text, and Escape leaves it as it was", async () => {
  await page.locator("#canvas").focus();
  await page.keyboard.press("k");
  await page.keyboard.press("Enter");
  await page.keyboard.type("in the middle");
  await page.keyboard.press("Enter");
  assert.deepEqual(await labels().allTextContents(), ["1scratched here", "2in the middle"]);
  await labels().nth(1).focus();
  await page.keyboard.press("Enter");
  await page.keyboard.type(" no");
  await page.keyboard.press("Escape");
  assert.deepEqual(await labels().allTextContents(), ["1scratched here", "2in the middle"]);
  await labels().nth(1).focus();
  await page.keyboard.press("Delete");
  assert.deepEqual(await labels().allTextContents(), ["1scratched here"]);
  await page.keyboard.press("k");
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#annotate-text").isHidden());
});

test("a text without words is none", async () => {
  await page.locator("#annotate").click();
  await click(0.5, 0.5);
  await field().fill("   ");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  assert.equal(await labels().count(), 1);
  assert.equal(await field().count(), 0);
});

test("where there is no room for another text the tool says so", async () => {
  const setAll = (rows) =>
    page.locator("#annotations-state").evaluate((input, value) => {
      input.value = value;
      input.dispatchEvent(new Event("input", { bubbles: true }));
    }, rows);
  const before = await page.locator("#annotations-state").inputValue();
  const row = ["a", 0, 0.5, 0.5, 0, "one of many"];
  await setAll(JSON.stringify(Array.from({ length: 60 }, () => row)));
  assert.equal(await page.locator("#annotation-list li").count(), 60);
  await page.locator("#annotate").click();
  assert.match(await page.locator("#annotate-text").textContent(), /^There is room for no more/);
  await page.keyboard.press("Enter");
  assert.equal(await field().count(), 0);
  await page.keyboard.press("Escape");
  await setAll(before);
  assert.deepEqual(await labels().allTextContents(), ["1scratched here"]);
});

test("a text moves with its model, is changed in the list, undone, and in the address", async () => {
  await drawn(page);
  const at = async () => (await page.locator("#annotations path").getAttribute("d")).split("L")[0];
  const before = await at();
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.2"));
  await drawn(page);
  assert.notEqual(await at(), before);
  await opened.until("done", () => page.locator("#move-x-exact").fill("0"));
  // Undo steps over what was recorded: the position rests first.
  await page.waitForTimeout(300);
  await page.getByRole("button", { name: "Change annotation 1" }).click();
  await field().fill("dent");
  await field().press("Enter");
  await page.waitForFunction(() =>
    new URLSearchParams(location.hash.slice(1)).get("annotations")?.includes("dent"),
  );
  await page.locator("#undo").click();
  assert.deepEqual(await labels().allTextContents(), ["1scratched here"]);
  await page.locator("#redo").click();
  assert.deepEqual(await labels().allTextContents(), ["1dent"]);
  await opened.screenshot("annotations");
});

test("a model that is hidden, and what is cut away, has no label", async () => {
  const side = await page.locator("#annotation-list b").first().textContent();
  await page.selectOption(`#show-${side.toLowerCase()}`, "hidden");
  await drawn(page);
  assert.ok(await labels().first().isHidden());
  await page.selectOption(`#show-${side.toLowerCase()}`, "auto");
  await drawn(page);
  assert.ok(await labels().first().isVisible());
});

test("the report has the label on its picture, and the text with its place", async () => {
  const saved = async (id) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(id).click()]);
    return readFileSync(await download.path(), "utf8");
  };
  const { annotations } = JSON.parse(await saved("#export-json"));
  assert.equal(annotations[0].text, "dent");
  const report = await saved("#export-report");
  assert.match(report, /<h2>Annotations<\/h2>/);
  assert.match(report, /dent/);
  // The label's paper is white on the view of the report, where the view itself has none.
  const isWhite = async (selector) =>
    page.evaluate(async (html) => {
      const address = /src="(data:image\/png[^"]+)"/.exec(html)[1];
      const bitmap = await createImageBitmap(await (await fetch(address)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        if (data[at] === 255 && data[at + 1] === 255 && data[at + 2] === 255) count++;
      }
      return count;
    }, selector);
  const withLabel = await isWhite(report);
  await page.getByRole("button", { name: "Remove annotation 1" }).click();
  const without = await isWhite(await saved("#export-report"));
  assert.ok(withLabel > without + 300, `${withLabel} ${without}`);
});

test("what an address says is checked", async () => {
  for (const text of ["[", "[[1]]", '[["c",0,0,0,0,"x"]]', '[["a",0,null,0,0,"x"]]', "7"]) {
    await page.evaluate((value) => {
      const control = document.querySelector("[name=annotations]");
      control.value = value;
      control.dispatchEvent(new Event("input", { bubbles: true }));
    }, text);
    assert.equal(await labels().count(), 0, text);
  }
});

test("labels do not lie over each other, nor outside of the view", async () => {
  const { cornersOf } = await moduleOf("annotations/layout.ts");
  const view = [400, 300];
  const all = [
    [10, 10],
    [20, 260],
    [395, 20],
    [200, 150],
    [204, 152],
    [202, 149],
    [390, 295],
  ].map((at) => ({ at, size: [90, 30] }));
  const legend = { corner: [0, 200], size: [60, 100] };
  const corners = cornersOf(all, view, [legend]);
  assert.equal(corners.length, all.length);
  for (const [index, [left, top]] of corners.entries()) {
    assert.ok(left >= 0 && left + 90 <= view[0] && top >= 0 && top + 30 <= view[1], `${index}`);
    assert.ok(left >= 60 || top + 30 <= 200, `${left} ${top}`);
    for (const [x, y] of corners.slice(0, index)) {
      assert.ok(Math.abs(x - left) >= 90 || Math.abs(y - top) >= 30, `${left} ${top}: ${x} ${y}`);
    }
  }
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
