// What the page says in each of its states, in which axe-core finds nothing, in light and dark.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { file, stepAssembly, stepSquares } from "../support/models.mjs";
import { open } from "../support/open.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];

let opened;
let page;

before(async () => {
  opened = await open({ path: "", unfolded: false });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
  await page.evaluate(axe);
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();

/** Scrolls the panel to its beginning: what is half beneath its head is a small target. */
const toTop = () => page.locator("#panel").evaluate((panel) => panel.scrollTo(0, 0));

/** Asserts that axe finds nothing in either scheme, and takes a picture in each. */
async function isAccessible(state) {
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    await drawn(page);
    const found = await page.evaluate(async (values) => {
      const { violations } = await globalThis.axe.run(document, {
        runOnly: { type: "tag", values },
      });
      return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target)}`);
    }, TAGS);
    assert.deepEqual(found, [], `${state}, ${colorScheme}`);
    await opened.screenshot(`state-${state}-${colorScheme}`);
  }
}

test("PASS, FAIL, and UNDECIDED at the distance itself", async () => {
  for (const [limit, badge] of [
    ["0.2", "FAIL"],
    ["0.4", "PASS"],
    ["0.35", "UNDECIDED"],
  ]) {
    await page.locator("#limit").fill(limit);
    await page.locator('#result[data-state="done"]').waitFor();
    assert.equal(await text("#badge"), badge);
    await isAccessible(badge.toLowerCase());
  }
  await page.locator("#limit").fill("0.2");
});

test("a section, compared faces, a clearance, and a file that is broken", async () => {
  await page.selectOption("#section-axis", "1");
  await page.locator("#cut svg").waitFor();
  await isAccessible("section");
  await page.selectOption("#section-axis", "");
  await page.locator("#compare").click();
  await page.locator('#faces[data-state="done"]').waitFor();
  await isAccessible("compared");
  await page.locator("#faces-clear").click();
  await page.locator("#clearance-details summary").click();
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-state="done"]').waitFor();
  // No control of the panel is cut in two by its steps.
  await page.locator("#clearance-details").evaluate((part) => part.scrollIntoView());
  await isAccessible("clearance");
  await opened.until("done", () => page.locator("#clearance-start").click());
  await page.setInputFiles("#file-a", file("cut.step", "ISO-10303-21;\n"));
  await page.locator("#error").waitFor();
  await isAccessible("broken");
});

test("with a face that was skipped on reading nothing passes, and the card says so", async () => {
  const squares = stepSquares(3);
  const unknown = squares.replace("PLANE('',", "FANCY_SURFACE('',");
  await opened.until("done", () => page.setInputFiles("#file-b", file("full.step", squares)));
  await opened.until("done", () => page.setInputFiles("#file-a", file("less.step", unknown)));
  await page.locator("#limit").fill("5");
  assert.equal(await text("#badge"), "UNDECIDED");
  assert.match(await text("#verdict"), /1 face was skipped/);
  assert.match(await text("#doubts"), /1 face skipped on reading/);
  await drawn(page);
  // The face that is missing lies at the left end, beside or above the legend, which covers no label.
  const [legend, label] = await Promise.all(
    ["#legend", "#label-from"].map((selector) => page.locator(selector).boundingBox()),
  );
  const isBeside = label.x >= legend.x + legend.width - 1;
  assert.ok(isBeside || label.y + label.height <= legend.y + 1, JSON.stringify({ legend, label }));
  await toTop();
  await isAccessible("skipped");
});

test("an assembly with its tree", async () => {
  for (const side of ["a", "b"]) {
    const machine = file(`machine-${side}.step`, stepAssembly());
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, machine));
  }
  await page.locator("#tree-list li").first().waitFor();
  await toTop();
  await isAccessible("assembly");
});

test("a telephone, with its sheet folded and pulled up", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.locator("#panel").evaluate((panel) => panel.scrollTo(0, 0));
  await isAccessible("telephone");
  await page.locator("#sheet").click();
  await isAccessible("telephone-sheet");
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
