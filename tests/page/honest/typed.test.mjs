// What is typed into a field of numbers is taken as it is meant, or marked.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openedForAll } from "../support/open.mjs";

const opened = openedForAll();

const verdict = () => opened.page.locator("#badge").getAttribute("data-verdict");

async function type(id, text) {
  await opened.page.locator(`#${id}`).fill("");
  await opened.page.locator(`#${id}`).pressSequentially(text);
  return opened.page.locator(`#${id}`).inputValue();
}

// The bracket and its revision are 0.35 apart.
test("a decimal comma is a point", async () => {
  assert.equal(await type("limit", "0,5"), "0.5");
  assert.equal(await verdict(), "pass");
  assert.equal(await type("limit", "0,2"), "0.2");
  assert.equal(await verdict(), "fail");
});

test("the deviation on the other side may have its sign", async () => {
  await type("limit", "0.5");
  await type("limit-below", "-0.2");
  assert.notEqual(await verdict(), "pass");
  const signed = await verdict();
  await type("limit-below", "0.2");
  assert.equal(await verdict(), signed);
  await type("limit-below", "");
  assert.equal(await verdict(), "pass");
});

test("what is no number of the range is marked, and nothing is judged by it", async () => {
  for (const text of ["-1", "1e"]) {
    await type("limit", text);
    assert.equal(await opened.page.locator("#limit").getAttribute("aria-invalid"), "true", text);
    assert.equal(await verdict(), null, text);
    assert.ok(await opened.page.locator("#no-limit").isVisible(), text);
  }
  await type("limit", "0.5");
  assert.equal(await opened.page.locator("#limit").getAttribute("aria-invalid"), "false");
  assert.ok(await opened.page.locator("#no-limit").isHidden());
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
