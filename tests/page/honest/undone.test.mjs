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
