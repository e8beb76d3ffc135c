// Undoing the choice of an example goes back to the pair before it, if that can be opened again.
import assert from "node:assert/strict";
import { test } from "node:test";
import { box, model } from "../support/boxes.mjs";
import { openedForAll } from "../support/open.mjs";

const opened = openedForAll();

const choose = (label) =>
  opened.until("done", () => opened.page.selectOption("#preset", { label }));
const shown = () =>
  Promise.all(
    ["shape-a", "shape-b", "limit"].map((id) => opened.page.locator(`#${id}`).inputValue()),
  );

test("the pair before is shown again, with its limit", async () => {
  await choose("Bracket and its revision");
  await opened.page.waitForFunction(() => location.hash.includes("limit=0.2"));
  const before = await shown();
  assert.equal(before[2], "0.2");
  await choose("Concentric spheres");
  await opened.page.waitForFunction(() => location.hash.includes("a=sphere"));
  assert.deepEqual(await shown(), ["sphere", "sphere-larger", ""]);
  await opened.until("done", () => opened.page.locator("#undo").click());
  assert.deepEqual(await shown(), before);
});

test("who leaves the page and goes back finds the verdict of what the fields say", async () => {
  const { page } = opened;
  await page.locator("#limit").fill("0.3");
  await opened.until("done", () => page.locator("#symmetric").check());
  await page.waitForFunction(() => /^(?!.*symmetric).*limit=0.3/.test(location.hash));
  const card = () =>
    Promise.all(["badge", "compared", "kind"].map((id) => page.locator(`#${id}`).textContent()));
  const before = await card();
  assert.equal(before[0], "FAIL");
  await page.goto(new URL("experiments.html", page.url()).href);
  // The browser then fills the fields by itself.
  await page.goBack();
  await page.locator('#result[data-state="done"]').waitFor();
  assert.equal(await page.locator("#limit").inputValue(), "0.3");
  assert.deepEqual(await card(), before);
  await page.locator("#symmetric").uncheck();
});

test("files cannot be opened again, and nothing is undone", async () => {
  const block = (name, height) => model(name, box("block", [0, 0, 0], [4, 3, height]));
  await opened.until("done", () =>
    opened.page.setInputFiles("#file-both", [block("a.json", 2), block("b.json", 2.5)]),
  );
  await choose("Concentric spheres");
  await opened.page.waitForFunction(() => location.hash.includes("a=sphere"));
  assert.ok(await opened.page.locator("#undo").isDisabled());
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
