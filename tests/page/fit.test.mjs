// The best fit: a shape that was moved and turned returns to itself, and undo takes it back.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { box, model } from "./support/boxes.mjs";
import { open } from "./support/open.mjs";

let opened;

before(async () => {
  opened = await open();
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const POSITION = ["x", "y", "z"].flatMap((axis) => [`move-${axis}`, `turn-${axis}`]);

/** The numbers of the position by their identifiers. */
const position = async () => {
  const values = POSITION.map((id) => opened.page.locator(`#${id}-exact`).inputValue());
  return Object.fromEntries((await Promise.all(values)).map((value, at) => [POSITION[at], +value]));
};

const moved = {
  "move-x": 0.08,
  "move-y": -0.05,
  "move-z": 0.1,
  "turn-x": 2,
  "turn-y": -1,
  "turn-z": 3,
};

test("a shape that was moved and turned returns", async () => {
  const { page } = opened;
  for (const side of ["a", "b"]) {
    await opened.until("done", () => page.locator(`#shape-${side}`).selectOption("wavy-sheet"));
  }
  for (const [id, value] of Object.entries(moved)) {
    await opened.until("done", () => page.locator(`#${id}-exact`).fill(`${value}`));
  }
  const before = Number((await opened.data()).lower);
  assert.ok(before > 0.05, `${before}`);
  // Undo steps over what was recorded: the numbers rest first.
  await page.waitForTimeout(300);
  await opened.until("done", () => page.locator("#best-fit").click());
  await page.waitForFunction(() => /steps\)/.test(document.getElementById("fit-text").textContent));
  assert.ok(Number((await opened.data()).upper) < 1e-6, JSON.stringify(await opened.data()));
  for (const [id, value] of Object.entries(await position())) {
    assert.ok(Math.abs(value) < 1e-6, `${id}: ${value}`);
  }
  assert.match(await page.locator("#fit-text").textContent(), /^RMS ≈ 0\.\d+ before, ≈ \S+ now/);
  await opened.screenshot("best-fit");
});

test("undo and redo a fit", async () => {
  const { page } = opened;
  await page.waitForTimeout(300);
  await opened.until("done", () => page.locator("#undo").click());
  assert.deepEqual(await position(), moved);
  await opened.until("done", () => page.locator("#redo").click());
  for (const value of Object.values(await position())) assert.ok(Math.abs(value) < 1e-6);
});

test("a bracket that lies on its back finds its place from another start", async () => {
  const { page } = opened;
  for (const side of ["a", "b"]) {
    await opened.until("done", () => page.locator(`#shape-${side}`).selectOption("bracket"));
  }
  await opened.until("done", () => page.locator("#turn-x-exact").fill("180"));
  assert.ok(Number((await opened.data()).lower) > 10);
  await opened.until("done", () => page.locator("#best-fit").click());
  await page.waitForFunction(() => /steps\)/.test(document.getElementById("fit-text").textContent));
  assert.ok(Number((await opened.data()).upper) < 1e-4, JSON.stringify(await opened.data()));
  assert.equal(await page.locator("#fit-text").getAttribute("data-poor"), "false");
});

test("what a fit counts is chosen", async () => {
  const { page } = opened;
  // 0.5 higher is the top of A alone: the other faces lie on those of B at once.
  const block = (name, height) => model(name, box("block", [0, 0, 0], [4, 3, height]));
  await opened.until("done", () =>
    page.setInputFiles("#file-both", [block("high.json", 2.5), block("low.json", 2)]),
  );
  const fitted = async () => {
    await page.locator("#best-fit").click();
    await page.waitForFunction(() =>
      /now \(/.test(document.getElementById("fit-text").textContent),
    );
    return page.locator("#fit-text").textContent();
  };
  assert.match(await fitted(), /^RMS ≈ 0\.\d*[1-9]\d* before, ≈ 0\.\d*[1-9]/);
  await opened.until("done", () => page.locator("#undo").click());
  await page.locator("#fit-faces").fill("0 and 1");
  await page.locator("#best-fit").click();
  assert.ok(await page.locator("#fit-faces").evaluate((input) => !input.validity.valid));
  // Also where it is folded away.
  await page.locator("#fit-choice").evaluate((choice) => {
    choice.open = false;
  });
  await page.locator("#best-fit").click();
  assert.ok(await page.locator("#fit-faces").isVisible());
  for (const list of ["0-", "0-1-2", "1,,2", "0-9999999"]) {
    await page.locator("#fit-faces").fill(list);
    assert.ok(await page.locator("#fit-faces").evaluate((input) => !input.validity.valid), list);
  }
  await page.locator("#fit-faces").fill("5, 4-0");
  await page.locator("#fit-distance").fill("0.001");
  assert.match(await fitted(), /^RMS ≈ 0\.0+ before, ≈ 0\.0+ now .*; \d+ of 1536 samples count/);
  await opened.screenshot("fit-choice");
  await page.locator("#fit-faces").fill("6");
  await page.locator("#best-fit").click();
  await page.locator("#error", { hasText: "face 6 of B" }).waitFor();
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
