// What a workplace chooses: light or dark, and the report's title, logo, paper and parts; both ends of the scale.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { moduleOf } from "../support/module.mjs";
import { open } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: "" });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

async function report() {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#export-report").click(),
  ]);
  return readFileSync(await download.path(), "utf8");
}

/** A picture of one pixel. */
const DOT = Buffer.from(
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==",
  "base64",
);

test("a report has the title, the logo, the paper and the parts that are wanted", async () => {
  const whole = await report();
  assert.match(whole, /size: A4/);
  assert.match(whole, /<h1>Comparison<\/h1>/);
  assert.match(whole, /<h2>Worst places<\/h2>/);
  await page.locator("#report-title").fill("First article");
  await page.locator("#report-part").fill("bracket 7");
  await page.selectOption("#report-paper", "letter");
  await page.setInputFiles("#report-logo", { name: "l.png", mimeType: "image/png", buffer: DOT });
  await page.locator("#report-logo-shown").waitFor();
  for (const part of ["places", "faces"]) {
    await page.locator(`#report-sections [value="${part}"]`).uncheck();
  }
  const chosen = await report();
  assert.match(chosen, /<h1>First article: bracket 7<\/h1><img src="data:image\/png/);
  assert.match(chosen, /size: letter/);
  assert.doesNotMatch(chosen, /<h2>(Worst places|Faces)<\/h2>/);
  assert.match(chosen, /<h2>Views<\/h2>/);
});

test("a view keeps the legend of its unit, and says that it is of another state", async () => {
  const captions = (html) =>
    [...html.matchAll(/<figcaption>(.*?)<\/figcaption>/gs)].map(([, said]) => said);
  await drawn(page);
  await page.locator("#add-view").click();
  await page.locator("#view-count", { hasText: /^1 view/ }).waitFor();
  const [same] = captions(await report());
  assert.match(same, /^View 1: Signed deviation of A and B, mm$/);
  await page.locator("#limit").fill("0.5");
  await page.selectOption("#shown-unit", "0.0254");
  await drawn(page);
  const html = await report();
  const said = captions(html);
  assert.match(said[0], /^View 1: Signed deviation of A and B, mm; as it was when it was added/);
  // The histogram is of what is shown now.
  assert.ok(said.includes("Signed deviation of A and B, in"), said.join("\n"));
  const legend = html.match(/<svg[^>]*class="legend".*?<\/svg>/s)[0];
  assert.match(legend, /allowed \+0\.200</);
  assert.match(html, /\+0\.0196850393701 \/ −0\.0196850393701 in/);
  await page.selectOption("#shown-unit", "");
  await page.locator("#limit").fill("0.2");
});

test("what is no picture of a logo is refused", async () => {
  await page.setInputFiles("#report-logo", {
    ...{ name: "l.txt", mimeType: "text/plain", buffer: Buffer.from("logo") },
  });
  await page.locator("#export-note", { hasText: /l\.txt is no picture/ }).waitFor();
});

test("light or dark is the user's, and is kept with paper and logo, and in no link", async () => {
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await page.emulateMedia({ colorScheme: "light" });
  const light = await ground();
  await page.locator("#help").click();
  await page.selectOption("#theme", "dark");
  await page.getByRole("button", { name: "Close", exact: true }).click();
  const dark = await ground();
  assert.notEqual(dark, light);
  assert.ok(!/theme|paper|logo/.test(await page.evaluate(() => location.hash)));
  await drawn(page);
  await opened.screenshot("dark");
  await page.reload();
  await page.locator('#result[data-state="done"]').waitFor();
  assert.equal(await ground(), dark);
  assert.equal(await page.locator("#report-paper").inputValue(), "letter");
  assert.ok(await page.locator("#report-logo-clear").isVisible());
  assert.ok(!(await page.locator('#report-sections [value="faces"]').isChecked()));
});

test("the scale has an end on each side of 0, with all colours of its half", async () => {
  const { ColorScale } = await moduleOf("scene/colors/scale.ts");
  const extent = { lowest: -1, highest: 1, largest: 1, floor: 1e-9 };
  const options = { map: "diverging", absolute: false, steps: 0, allowed: undefined };
  const even = new ColorScale(extent, { ...options, range: 1 });
  const uneven = new ColorScale(extent, { ...options, range: 2, rangeBelow: 0.5 });
  assert.deepEqual([uneven.low, uneven.high], [-0.5, 2]);
  for (const part of [0.25, 0.5, 1]) {
    assert.equal(uneven.color(2 * part).getHex(), even.color(part).getHex());
    assert.equal(uneven.color(-0.5 * part).getHex(), even.color(-part).getHex());
  }
  // What is farther has the colour of the end.
  assert.equal(uneven.color(-0.9).getHex(), uneven.color(-0.5).getHex());
  await page.locator("#scale-range").fill("0.3");
  await page.locator("#scale-range-below").fill("0.1");
  assert.match(await page.locator("#scale-low").textContent(), /^−0\.10/);
  assert.match(await page.locator("#scale-high").textContent(), /^\+0\.30/);
});

test("all of the page is reached where it is enlarged to 200 %", async () => {
  // As a browser lays it out: half as many pixels.
  await page.setViewportSize({ width: 640, height: 400 });
  await drawn(page);
  const reached = await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
  assert.ok(reached);
  for (const id of ["limit", "export-pages", "best-fit"]) {
    await page.locator(`#${id}`).scrollIntoViewIfNeeded();
    const { x, width } = await page.locator(`#${id}`).boundingBox();
    assert.ok(x >= 0 && x + width <= 640, `${id}: ${x} ${width}`);
  }
  await opened.screenshot("enlarged");
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
