// Accessibility: axe-core finds nothing, in light and dark, on wide and narrow screens.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";
import { drawn } from "./support/drawn.mjs";
import { modelFile, row } from "./support/models.mjs";
import { open } from "./support/open.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** The rules of WCAG 2.2 on levels A and AA, and axe's own best practices. */
const TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];

async function findings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(
    (values) => globalThis.axe.run(document, { runOnly: { type: "tag", values } }),
    TAGS,
  );
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(" ")}`);
}

/** The page is opened in the first scheme, and changes to the second. */
const screens = [
  { name: "wide", size: { width: 1280, height: 800 }, schemes: ["light", "dark"] },
  { name: "narrow", size: { width: 400, height: 800 }, schemes: ["dark", "light"] },
];

for (const { name, size, schemes } of screens) {
  test(`the main page, ${name}, ${schemes.join(" and ")}, with all that it can show`, async () => {
    const prepare = (page) => page.emulateMedia({ colorScheme: schemes[0] });
    const { page, until, screenshot, close } = await open({ size, prepare });
    try {
      await page.locator('#result[data-state="done"]').waitFor();
      for (const [side, heights] of [
        ["a", [0, 0]],
        ["b", [0, 0.5]],
      ]) {
        const file = modelFile(`${side}.json`, row(...heights));
        await until("done", () => page.setInputFiles(`#file-${side}`, file));
      }
      await page.locator("#limit").fill("0.1");
      await until("done", () => page.locator("#deviation").check());
      // On a narrow screen the parts and faces are folded away at first.
      if (name === "narrow") await page.locator("#side-toggle").click();
      await page.locator("#compare").click();
      await page.locator('#faces[data-state="done"]').waitFor();
      // What is scrolled out of the panel does not lie behind the list of parts.
      await page.locator("#panel").evaluate((panel) => panel.scrollTo(0, 0));
      await page.selectOption("#section-axis", "0");
      await page.locator("#canvas").focus();
      await page.keyboard.press("Enter");
      for (const colorScheme of schemes) {
        await page.emulateMedia({ colorScheme });
        await drawn(page);
        assert.deepEqual(await findings(page), [], colorScheme);
        await screenshot(`access-${name}-${colorScheme}`);
      }
    } finally {
      await close();
    }
  });
}

for (const [path, selector] of [
  ["experiments.html", '#sweep[data-state="ready"]'],
  ["deforming.html", '#run[data-state="running"]'],
]) {
  test(`the page ${path}`, async () => {
    const { page, close } = await open({ path });
    try {
      await page.locator(selector).waitFor();
      assert.deepEqual(await findings(page), []);
    } finally {
      await close();
    }
  });
}
