// Alignment by hand: faces and points of A are picked with those of B, both models side by side.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { box, model } from "../support/boxes.mjs";
import { drawn } from "../support/drawn.mjs";
import { open, PLAIN } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: PLAIN, size: { width: 1280, height: 800 } });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
  const block = (name, at) =>
    model(
      name,
      box(
        "block",
        at,
        [4, 3, 2].map((size, axis) => at[axis] + size),
      ),
    );
  await opened.until("done", () =>
    page.setInputFiles("#file-both", [
      block("a.json", [0, 0, 0]),
      block("b.json", [0.125, 0.25, 0.0625]),
    ]),
  );
  await drawn(page);
});

after(() => opened.close());

const asked = () => page.locator("#picks-text").textContent();

/** Clicks in the half of a model, from its middle, in pixels: models are below it where the picks are asked for. */
async function click(side, across, down) {
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await drawn(page);
  await page.mouse.click(x + (side === "a" ? 0.25 : 0.75) * width + across, y + height / 2 + down);
}

test("three faces of A are laid on those of B, and A lies on B", async () => {
  await page.locator("#align-picks").click();
  assert.ok(await page.locator("#beside").isChecked());
  await page.selectOption("#picks-kind", "faces");
  assert.match(await asked(), /^Click a face of A\./);
  // A click in the half of the other model is not what is asked for.
  await click("b", 0, -40);
  assert.match(await asked(), /^Click a face of A\./);
  for (const [across, down] of [
    [-10, 16],
    [-84, 76],
    [91, 106],
  ]) {
    await click("a", across, down);
    assert.match(await asked(), /^Click the face of B/);
    await click("b", across, down);
  }
  assert.match(await asked(), /^3 pairs are the most/);
  assert.equal(await page.locator(".pick-mark").count(), 6);
  await drawn(page);
  await opened.screenshot("align-picks");
  await opened.until("done", () => page.locator("#picks-lay").click());
  assert.ok(await page.locator("#picks-controls").isHidden());
  assert.ok(!(await page.locator("#wipe").isChecked()));
  assert.match(await page.locator("#fit-text").textContent(), /laid on by hand/);
  await page.locator("#where", { hasText: "The models agree" }).waitFor();
  const moved = await Promise.all(
    ["x", "y", "z"].map((axis) => page.locator(`#move-${axis}-exact`).inputValue()),
  );
  for (const [axis, shift] of [0.125, 0.25, 0.0625].entries()) {
    assert.ok(Math.abs(Number(moved[axis]) - shift) < 1e-6, moved.join());
  }
});

test("fewer points than determine a motion are refused, and the last pick is undone", async () => {
  await page.locator("#align-picks").click();
  await page.selectOption("#picks-kind", "points");
  await click("a", -10, 16);
  await click("b", -10, 16);
  assert.match(await asked(), /2 more pairs are needed/);
  assert.ok(await page.locator("#picks-lay").isDisabled());
  await page.locator("#picks-undo").click();
  assert.match(await asked(), /^Click the point of B/);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#picks-controls").isHidden());
});

test("both models are drawn side by side by one camera, each where its pointer finds it", async () => {
  await page.locator("#wipe").check();
  await page.locator("#beside").check();
  await drawn(page);
  await opened.screenshot("beside");
  await page.locator("#canvas").focus();
  await click("a", 0, -40);
  await click("b", 0, -40);
  await page.locator(".pin").nth(1).waitFor();
  const names = await page.locator(".pin span:nth-child(2)").allTextContents();
  assert.deepEqual(
    names.map((name) => name[0]),
    ["A", "B"],
  );
  // The same face of both, at the same place of either half.
  assert.equal(names[0].split(" · ")[0].slice(2), names[1].split(" · ")[0].slice(2));
  // A pin has its place with the next picture.
  await page.waitForFunction(() =>
    [...document.querySelectorAll(".pin")].every(({ style }) => style.left !== ""),
  );
  const [a, b] = await page
    .locator(".pin")
    .evaluateAll((pins) => pins.map(({ style }) => Number.parseFloat(style.left)));
  const { width } = await page.locator("#canvas").boundingBox();
  assert.ok(Math.abs(b - a - width / 2) < 3, `${a} ${b}`);
  await page.locator("#wipe").uncheck();
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
