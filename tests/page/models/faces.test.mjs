// The comparison of faces on the page.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { file, modelFile, row, sphereParts, stepAssembly } from "../support/models.mjs";
import { open } from "../support/open.mjs";
import { countPixels } from "../support/pixels.mjs";

let opened;

before(async () => {
  opened = await open({ size: { width: 1530, height: 848 } });
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

async function openPair(a, b) {
  for (const [side, model] of Object.entries({ a, b })) {
    await opened.until("done", () =>
      opened.page.setInputFiles(`#file-${side}`, modelFile(`${side}.json`, model)),
    );
  }
}

/** Faces that are compared in several seconds. */
const MANY_FACES = 120;

const reaches = (state) => opened.page.locator(`#faces[data-state="${state}"]`).waitFor();

async function compare(limit) {
  await opened.page.locator("#face-limit").fill(`${limit}`);
  await opened.page.locator("#compare").click();
  await reaches("done");
}

const rows = () =>
  opened.page.locator("#face-list button").evaluateAll((buttons) =>
    buttons.map((button) => {
      const { side, face, state } = button.dataset;
      return {
        side,
        face: Number(face),
        state,
        interval: button.querySelector(".interval").textContent,
      };
    }),
  );

/** Waits until the arrow's label has this text and is in the middle of the view. */
const labelReads = (text) =>
  opened.page.waitForFunction((text) => {
    const label = document.getElementById("label");
    const view = document.getElementById("canvas").getBoundingClientRect();
    const { x, y, width } = label.getBoundingClientRect();
    const near = (at, from, size) => Math.abs(at - (from + size / 2)) < 0.4 * size;
    const centred = near(x, view.x, view.width) && near(y, view.y, view.height);
    return label.textContent === text && width > 0 && centred;
  }, text);

test("the two raised ones of five squares are listed, the largest first, and nothing else", async () => {
  await openPair(row(0, 0, 0, 0, 0), row(0, 0.25, 0, 0.5, 0));
  await compare(0.01);
  const { page } = opened;
  assert.equal(await page.locator("#faces").getAttribute("data-result"), "changed");
  const listed = await rows();
  assert.deepEqual(
    listed.map(({ face, state }) => [face, state]),
    [
      [3, "changed"],
      [3, "changed"],
      [1, "changed"],
      [1, "changed"],
    ],
  );
  assert.deepEqual(new Set(listed.map(({ side }) => side)), new Set(["a", "b"]));
  for (const [index, { interval }] of listed.entries()) {
    const [lower, upper] = JSON.parse(interval);
    const raised = index < 2 ? 0.5 : 0.25;
    assert.ok(lower <= raised && raised <= upper && upper - lower < 0.01 * raised, interval);
  }
  const summary = await page.locator("#face-summary").textContent();
  for (const side of ["A", "B"]) {
    assert.ok(summary.includes(`${side}: 2 changed, 0 undecided, 3 unchanged`), summary);
  }
  await opened.screenshot("faces");
});

test("a selected face is zoomed to with its own arrow; keys select the next one and none", async () => {
  const { page } = opened;
  const buttons = page.locator("#face-list button");
  await buttons.first().click();
  assert.equal(await buttons.first().getAttribute("aria-pressed"), "true");
  await labelReads("0.5000");
  await opened.screenshot("faces-selected");
  await page.keyboard.press("End");
  assert.equal(await buttons.last().getAttribute("aria-pressed"), "true");
  assert.equal(await buttons.first().getAttribute("aria-pressed"), "false");
  await labelReads("0.2500");
  await page.keyboard.press("Escape");
  assert.equal(await page.locator('#face-list [aria-pressed="true"]').count(), 0);
  await page.locator("#label").waitFor({ state: "hidden" });
  await page.locator("#faces-clear").click();
  await page.locator("#label").waitFor();
  assert.equal(await buttons.count(), 0);
});

test("at a limit above the changes every face is unchanged, and a move outdates that", async () => {
  const { page } = opened;
  await compare(0.6);
  assert.equal(await page.locator("#faces").getAttribute("data-result"), "unchanged");
  assert.equal(await page.locator("#face-list button").count(), 0);
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.1"));
  await reaches("outdated");
  assert.match(await page.locator("#face-summary").textContent(), /A was moved/);
  await compare(0.05);
  const { length } = await rows();
  assert.equal(length, 10, "all ten faces moved by 0.1");
});

test("a long comparison is cancelled", async () => {
  const { page } = opened;
  const { a, b } = sphereParts;
  const surfaces = Array.from({ length: MANY_FACES }, () => a.surfaces[0]);
  await page.selectOption("#tolerance", "1e-3");
  await openPair({ surfaces }, b);
  await page.locator("#face-limit").fill("0.001");
  await page.locator("#compare").click();
  // At once, since a click of the browser waits for a frame.
  await page.locator('#faces[data-state="working"]').evaluate(() => {
    document.getElementById("compare-cancel").click();
  });
  await reaches("cancelled");
  assert.equal(await page.locator("#face-list button").count(), 0);
});

test("a limit that is not positive is not compared with", async () => {
  const { page } = opened;
  await page.locator("#face-limit").fill("-1");
  await page.locator("#compare").click();
  assert.equal(await page.locator("#faces").getAttribute("data-state"), "cancelled");
});

test("faces are compared with what is allowed until another limit is typed", async () => {
  const { page } = opened;
  const limit = page.locator("#face-limit");
  await openPair(sphereParts.a, sphereParts.b);
  await page.locator("#limit").fill("0.25");
  assert.equal(await limit.inputValue(), "0.25");
  await page.locator("#limit-below").fill("0.125");
  assert.equal(await limit.inputValue(), "0.125");
  await limit.fill("0.5");
  await page.locator("#limit").fill("0.375");
  assert.equal(await limit.inputValue(), "0.5");
  await openPair(sphereParts.b, sphereParts.a);
  assert.equal(await limit.inputValue(), "0.125");
  await page.locator("#limit-below").fill("");
  assert.equal(await limit.inputValue(), "0.375");
  await page.locator("#limit").fill("");
});

/** The model of faces with these names, in a row. */
const named = (...names) => {
  const { surfaces } = row(...names.map(() => 0));
  return { surfaces: surfaces.map((surface, index) => ({ ...surface, part: names[index] })) };
};

test("the faces of an assembly are listed by parts, which are hidden and isolated", async () => {
  const { page } = opened;
  const bolt = ["bolt / head", "bolt / shaft"];
  await openPair(named("plate / top", "plate / side", ...bolt, ...bolt), named("single", "other"));
  const parts = page.locator("#tree-list .part > div");
  await parts.first().waitFor();
  const names = (selector) => page.locator(`#tree-list ${selector}`).allTextContents();
  assert.deepEqual(await names(".part > div .name"), ["plate", "bolt", "bolt (2)"]);
  // Parts are folded, and faces that belong to none are listed as they are.
  assert.deepEqual(await names(".face .name"), ["single", "other"]);
  await parts.nth(2).locator(".unfold").click();
  assert.deepEqual(await names(".part .face .name"), ["head", "shaft"]);
  assert.ok(await page.evaluate(() => document.activeElement.classList.contains("unfold")));
  await page.locator("#tree-list .part .face input[type=checkbox]").first().uncheck();
  const box = parts.nth(2).locator("input[type=checkbox]");
  assert.ok(await box.evaluate((node) => node.indeterminate));
  await box.check();
  assert.equal(await page.locator("#tree-list .part .face input:checked").count(), 2);
  // One part alone: of the others neither a face of A nor one of B is drawn.
  await parts.nth(1).getByText("only").click();
  const shown = await page
    .locator("#tree-list input:checked")
    .evaluateAll((boxes) => boxes.map((box) => box.getAttribute("aria-label")));
  assert.deepEqual(shown, ["Show A bolt"]);
  await page.locator("#tree-all").click();
  await page.locator("#tree-filter").fill("plate / s");
  assert.deepEqual(await names(".name"), ["plate", "side"]);
  await opened.screenshot("parts");
  await page.locator("#tree-filter").fill("");
});

test("an assembly in an assembly is listed by levels, each hidden, isolated and filtered", async () => {
  const { page } = opened;
  const color = ["0.9", "0.5", "0.1"];
  for (const side of ["a", "b"]) {
    await opened.until("done", () =>
      page.setInputFiles(
        `#file-${side}`,
        file(`${side}.step`, stepAssembly(side === "a" ? { color } : {})),
      ),
    );
  }
  const list = page.locator("#tree-list");
  const names = (selector) => list.locator(selector).allTextContents();
  const of = (name) => list.getByRole("checkbox", { name, exact: true });
  // One row for each model, folded.
  assert.deepEqual(await names(".name"), ["machine", "machine"]);
  await page.getByLabel("Contents of A machine", { exact: true }).click();
  assert.deepEqual(await names(".name"), ["machine", "pump", "pump (spare)", "machine"]);
  await page.getByLabel("Contents of A machine / pump (spare)", { exact: true }).click();
  await page
    .getByLabel("Contents of A machine / pump (spare) / in / out (2)", { exact: true })
    .click();
  assert.deepEqual(await names(".part .part .part .name"), [
    "in / out",
    "in / out (2)",
    "low",
    "high",
  ]);
  await opened.screenshot("assembly");
  // Hiding a level in the middle hides what is below it, and all above show that some is hidden.
  await of("Show A machine / pump (spare) / in / out (2)").uncheck();
  assert.equal(await of("Show A machine / pump (spare) / in // out (2) / low").isChecked(), false);
  const mixed = (name) => of(name).evaluate((node) => node.indeterminate);
  assert.deepEqual(
    [await mixed("Show A machine / pump (spare)"), await mixed("Show A machine")],
    [true, true],
  );
  assert.equal(await of("Show A machine / pump").isChecked(), true);
  // One sub-assembly alone.
  await page.getByLabel("Show only A machine / pump (spare)", { exact: true }).click();
  assert.deepEqual(
    [
      await of("Show A machine / pump (spare)").isChecked(),
      await of("Show A machine / pump").isChecked(),
    ],
    [true, false],
  );
  assert.equal(await of("Show B machine").isChecked(), false);
  await page.locator("#tree-all").click();
  // The filter finds names of any level, and shows the way to them.
  await page.locator("#tree-filter").fill("spare) / in / out / l");
  assert.deepEqual(await names(".name"), [
    ...["machine", "pump (spare)", "in / out", "low"],
    ...["machine", "pump (spare)", "in / out", "low"],
  ]);
  await page.locator("#tree-filter").fill("");
  // A is raised, so that all its faces are beyond what is allowed; then none is. Those of B are not judged one way.
  await page.locator("#limit").fill("0.1");
  await opened.until("done", () => page.locator("#deviation").check());
  await opened.until("done", () => page.locator("#move-z-exact").fill("0.5"));
  await page.locator("#tree-changed").check();
  assert.equal((await names(".face .name")).length, 8);
  await page.locator("#limit").fill("0.6");
  await page.waitForFunction(() => document.querySelectorAll("#tree-list .name").length === 0);
  await page.locator("#tree-changed").uncheck();
  await page.locator("#deviation").uncheck();
});

test("models are shown in the colours of their files on request, also from a link, and undone", async () => {
  const { page } = opened;
  const box = page.locator("#file-colors");
  await box.waitFor();
  assert.equal(await box.isChecked(), false);
  await page.selectOption("#show-a", "solid");
  await page.selectOption("#show-b", "hidden");
  await page.locator("#fit").click();
  const orange = "r > 150 && g < 0.75 * r && b < 0.5 * r";
  const without = await countPixels(page, orange);
  await box.check();
  assert.match(
    await page.locator("#file-colors-note").textContent(),
    /Edges keep the colours of A and B/,
  );
  const shown = await countPixels(page, orange);
  assert.ok(shown > without + 1000, `${shown} after ${without}`);
  await opened.screenshot("file-colors");
  await page.waitForFunction(() => location.hash.includes("file-colors=on"));
  await page.keyboard.press("Control+z");
  assert.equal(await box.isChecked(), false);
  await page.keyboard.press("Control+Shift+z");
  assert.equal(await box.isChecked(), true);
  // What is painted keeps the colours of its deviation.
  await opened.until("done", () => page.locator("#deviation").check());
  assert.ok((await countPixels(page, orange)) < 1000);
  // Files without colours have no such choice.
  await openPair(row(0), row(0.1));
  await box.waitFor({ state: "hidden" });
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
