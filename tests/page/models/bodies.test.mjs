// Facts, volumes in common, checks of bodies and revisions of parts, on one page.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { box, model } from "../support/boxes.mjs";
import { open, PLAIN } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: `${PLAIN}&paint=a`, size: { width: 1110, height: 620 } });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const openPair = (a, b) => opened.until("done", () => page.setInputFiles("#file-both", [a, b]));

const reaches = (id, state) => page.locator(`#${id}[data-state="${state}"]`).waitFor();

/** The numbers of the table of facts by the names of their rows, without parts in percent. */
const facts = async () =>
  Object.fromEntries(
    await page.locator("#facts-table tbody tr:not(.ranges)").evaluateAll((rows) =>
      rows.map(({ cells }) => {
        const [name, ...numbers] = [...cells].map((cell) => cell.firstChild?.textContent ?? "");
        return [name, numbers];
      }),
    ),
  );

test("facts of both models and their differences are the numbers of boxes", async () => {
  await openPair(
    model("a.json", box("block", [0, 0, 0], [2, 2, 2])),
    model("b.json", box("block", [-1, -1, -1], [2, 2, 2])),
  );
  await page.locator("#facts-start").click();
  await reaches("facts-card", "done");
  const rows = await facts();
  assert.deepEqual(rows.Volume, ["8.00000", "27.0000", "19.0000"]);
  assert.equal(await page.locator("#facts-table .percent").first().textContent(), "+237.5 %");
  assert.deepEqual(rows.Area, ["24.0000", "54.0000", "30.0000"]);
  assert.deepEqual(rows["Extent x"], ["2.00000", "3.00000", "1.00000"]);
  const centroid = rows["Centroid z"].map((text) =>
    Number(text.replace("−", "-").replace("…", "")),
  );
  assert.deepEqual(centroid, [1, 0.5, -0.5]);
  assert.deepEqual(rows.Bodies, ["1 solid", "1 solid", ""]);
  assert.equal(rows["Mass, g"], undefined);
});

test("a density gives masses, and inches the same box in inches", async () => {
  await page.locator("#density").fill("7.85");
  // 8 mm³ of 7.85 g/cm³, and 27.
  assert.deepEqual((await facts())["Mass, g"].map(Number), [0.0628, 0.21195, 0.14915]);
  await page.locator("#shown-unit").selectOption("0.0254");
  await page.getByText("Lengths, areas and volumes: in, in², in³.").waitFor();
  const [a] = (await facts()).Volume;
  const digits = a.replace("…", "");
  assert.ok(`${8 / 25.4 ** 3}`.startsWith(digits.slice(0, -1)), a);
  await page.locator("#facts-intervals").check();
  const range = await page.locator("#facts-table .ranges").first().textContent();
  const [lower, upper] = /A in \[(.*?), (.*?)\]/.exec(range).slice(1).map(Number);
  assert.ok(lower <= 8 / 25.4 ** 3 && 8 / 25.4 ** 3 <= upper, range);
  await page.locator("#facts-intervals").uncheck();
  await page.locator("#shown-unit").selectOption("");
  await opened.screenshot("facts");
});

test("the volume in common and its ratio hold those of boxes, and are gone when A is moved", async () => {
  await page.locator("#overlap-start").click();
  await reaches("overlap", "done");
  const texts = await opened.texts("#overlap-list");
  const holds = (text, number) => {
    const [lower, upper] = /\[(.*), (.*)\]/.exec(text).slice(1).map(Number);
    assert.ok(lower <= number && number <= upper && upper - lower < 0.1, `${text}: ${number}`);
  };
  holds(texts["In common, mm³"], 8);
  holds(texts["Of B alone, mm³"], 19);
  holds(texts["In common / together"], 8 / 27);
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.5"));
  await reaches("overlap", "idle");
  await page.getByText("A was moved: measure again.").waitFor();
});

test("a check lists what clashes and touches, and which body is open, and shows two bodies alone", async () => {
  const rack = model(
    "rack.json",
    box("rack / shelf", [0, 0, 0], [4, 4, 1]),
    box("rack / peg", [1, 1, 0.5], [2, 2, 3]),
    box("rack / block", [4, 0, 0], [5, 4, 1]),
    box("rack / tray", [0, 0, 6], [1, 1, 7], { lid: false }),
  );
  await openPair(rack, model("b.json", box("block", [0, 0, 0], [1, 1, 1])));
  await page.locator("#check-of").selectOption("a");
  await page.locator("#check-start").click();
  await reaches("check", "done");
  assert.equal(
    await page.locator("#check-text").textContent(),
    "CLASH: 1 of 6 pairs; 1 touching, 0 near",
  );
  const [clash, touching] = await page.locator("#check-pairs li").allTextContents();
  assert.match(clash, /^clashshelf and peg.*volume 0\.5/);
  assert.match(touching, /^touchingshelf and block/);
  assert.deepEqual(await page.locator("#check-bodies li").allTextContents(), ["trayopen"]);
  await page.locator("#check-pairs button").first().click();
  await page.locator("#label", { hasText: /^clash$/ }).waitFor();
  await page.getByRole("button", { name: "Contents of A rack", exact: true }).click();
  const shown = (name) => page.getByLabel(`Show A rack / ${name}`, { exact: true }).isChecked();
  assert.deepEqual(await Promise.all(["shelf", "peg", "block"].map(shown)), [true, true, false]);
  await opened.screenshot("check");
  await page.locator("#check-back").click();
  assert.ok(await shown("block"));
});

test("a model that is not closed has no volume in common, and the page says so", async () => {
  await page.locator("#overlap-start").click();
  await page.getByText("A is not closed, so that it has no inside.").waitFor();
  const { Volume: volume } = await facts();
  assert.deepEqual(volume, ["not closed", "1.00000", ""]);
});

test("both files are checked together, and what was found is gone once A was moved", async () => {
  await page.locator("#check-of").selectOption("both");
  await page.locator("#check-start").click();
  await reaches("check", "done");
  const rows = await page.locator("#check-pairs li").allTextContents();
  assert.ok(
    rows.some((row) => /^clashA shelf and B block/.test(row)),
    rows.join("; "),
  );
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.5"));
  await reaches("check", "idle");
  await page.getByText("A was moved: check again.").waitFor();
});

test("what became of each part stands in the tree, in a line and in a list", async () => {
  const before = [
    box("kit / base", [0, 0, 0], [4, 4, 1]),
    box("kit / pin", [1, 1, 2], [2, 2, 3]),
    box("kit / cap", [0, 0, 6], [4, 3, 7]),
  ];
  const later = [
    box("kit / base", [0, 0, 0], [4, 4, 1]),
    box("kit / pin", [1, 1, 4], [2, 2, 5]),
    box("kit / cap", [0, 0, 6], [4, 3, 7.5]),
    box("kit / knob", [6, 6, 0], [6.5, 6.25, 1]),
  ];
  await openPair(model("kit.json", ...before), model("kit-2.json", ...later));
  await page.locator("#face-limit").fill("0.001");
  await page.locator("#compare").click();
  await reaches("faces", "done");
  const summary = await page.locator("#part-summary").textContent();
  assert.equal(summary, "3 of 4 parts are not the same: 1 moved; 1 changed; 1 added.");
  const rows = await page.locator("#part-list li").allTextContents();
  assert.ok(
    rows.some((row) => /^pinmovedby 2\.\d+ mm along z$/.test(row)),
    rows.join("; "),
  );
  assert.ok(
    rows.some((row) => /^capchanged\d faces?, at most 0\.5/.test(row)),
    rows.join("; "),
  );
  const unfold = page.getByRole("button", { name: "Contents of A kit" });
  if ((await unfold.getAttribute("aria-expanded")) === "false") await unfold.click();
  const states = await page
    .locator("#tree-list .part > div")
    .evaluateAll((rows) =>
      rows.map(
        (row) =>
          `${row.querySelector("b").textContent} ${row.querySelector(".name").textContent}: ${row.querySelector(".state").textContent}`,
      ),
    );
  for (const state of ["A base: same", "A pin: moved", "A cap: changed"]) {
    assert.ok(states.includes(state), states.join("; "));
  }
  await page.locator("#part-list button").first().click();
  await opened.screenshot("parts");
});

test("the report and the JSON have facts, check and parts", async () => {
  await page.locator("#check-of").selectOption("b");
  await page.locator("#check-start").click();
  await reaches("check", "done");
  const saved = async (id) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(id).click()]);
    return readFileSync(await download.path(), "utf8");
  };
  const { facts: found, check, faces } = JSON.parse(await saved("#export-json"));
  // Boxes of 16, 1 and 12 cubic millimetres.
  const { lower, upper } = found.a.facts.volume;
  assert.ok(lower <= 29 && 29 <= upper && upper - lower < 1e-6, `${lower} ${upper}`);
  assert.equal(check.clean, true);
  assert.equal(faces.parts.length, 4);
  const report = await saved("#export-report");
  for (const part of [
    "Facts of the files as they are",
    "29.0000 in [28.99",
    "Check of the bodies of B: CLEAN: 6 pairs, 0 touching, 0 near",
    "3 of 4 parts are not the same",
  ]) {
    assert.ok(report.includes(part), part);
  }
});

test("axe-core finds nothing in what is shown of bodies, in light and dark", async () => {
  await page.evaluate(
    readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"),
  );
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    const { violations } = await page.evaluate(() =>
      globalThis.axe.run({ include: ["#facts-card", "#check", "#faces"] }),
    );
    assert.deepEqual(
      violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(" ")}`),
      [],
      colorScheme,
    );
  }
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
