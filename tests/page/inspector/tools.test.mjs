// The bar of tools: keys, what is said of tools, the steps of the panel, measuring in the view.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { modelFile, planes } from "../support/models.mjs";
import { open } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: "", unfolded: false });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();

test("every tool has a name and something that is said of it, and every key is of one tool", async () => {
  const tools = await page.locator("#bar .tool").evaluateAll((all) =>
    all.map((tool) => {
      const control = tool.querySelector("input, select") ?? tool;
      const name = control.ariaLabel ?? control.textContent.trim();
      return { name, tip: tool.dataset.tip, key: control.dataset.key };
    }),
  );
  assert.ok(tools.length >= 16, `${tools.length}`);
  for (const { name, tip } of tools) assert.ok(name && tip, `${name}: ${tip}`);
  const keys = tools.flatMap(({ key }) => key ?? []);
  assert.equal(new Set(keys).size, keys.length, keys.join());
});

test("a tool that is pointed at says what it does and its key", async () => {
  await page.locator("#fit").hover();
  await page.locator("#tip", { hasText: "Show both models" }).waitFor();
  assert.equal(await text("#tip kbd"), "F");
  await page.mouse.move(600, 400);
  await page.locator("#tip").waitFor({ state: "hidden" });
});

test("keys do what their tools do, but not where text is typed", async () => {
  await page.locator("#canvas").focus();
  await page.keyboard.press("o");
  assert.ok(await page.locator("#orthographic").isChecked());
  await page.keyboard.press("o");
  assert.ok(!(await page.locator("#orthographic").isChecked()));
  await page.locator("#tree-filter").focus();
  await page.keyboard.press("o");
  assert.ok(!(await page.locator("#orthographic").isChecked()));
  await page.locator("#tree-filter").fill("");
});

test("the list of shortcuts names every key, and closes again", async () => {
  await page.locator("#canvas").focus();
  await page.keyboard.press("?");
  await page.locator("#shortcuts[open]").waitFor();
  const keys = await page.locator("#shortcut-list kbd").allTextContents();
  for (const key of ["F", "N", "M", "?", "Esc", "Ctrl+Z"]) assert.ok(keys.includes(key), key);
  await opened.screenshot("shortcuts");
  await page.keyboard.press("Escape");
  await page.locator("#shortcuts").waitFor({ state: "hidden" });
});

test("the list of parts is folded away and back", async () => {
  await page.locator("#canvas").focus();
  await page.keyboard.press("t");
  await page.locator("#side").waitFor({ state: "hidden" });
  await page.keyboard.press("t");
  await page.locator("#side").waitFor();
});

test("the card says the distance beside what is allowed, and its place is a link", async () => {
  assert.equal(await text("#badge"), "FAIL");
  assert.equal(
    (await text(".headline")).replace(/\s+/g, " ").trim(),
    "FAIL 0.350 mm > 0.200 allowed",
  );
  assert.ok(await page.locator("#interval").isHidden());
  await page.getByText("How certain?").click();
  assert.ok(await page.locator("#interval").isVisible());
  const before = await page.locator("#label").boundingBox();
  await page.getByRole("button", { name: /^Farthest/ }).click();
  await drawn(page);
  const after = await page.locator("#label").boundingBox();
  assert.ok(Math.hypot(after.x - before.x, after.y - before.y) > 50, "the place is looked at");
});

test("a step is shown and marked by its button", async () => {
  await page.setViewportSize({ width: 1280, height: 640 });
  await page.locator('[data-step="step-deviation"]').click();
  await page.locator('[data-step="step-deviation"][aria-current="step"]').waitFor();
  const { y } = await page.locator("#step-deviation").boundingBox();
  assert.ok(y >= 0 && y < 140, `${y}`);
  await page.setViewportSize({ width: 1280, height: 800 });
});

test("two points that are clicked are measured, with the angle of their faces", async () => {
  for (const [side, height] of [
    ["a", 0],
    ["b", 0.25],
  ]) {
    const file = modelFile(`${side}.json`, planes(height));
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, file));
  }
  await page.selectOption("#direction", "top");
  await drawn(page);
  await page.locator("#measure").click();
  assert.match(await text("#measure-text"), /first point/);
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  const says = (what) => page.locator("#measure-text").filter({ hasText: what }).waitFor();
  // The text is of one and of two lines in turn; the models stay where they are.
  for (const down of [0.4, 0.45, 0.5, 0.55, 0.6, 0.65]) {
    await page.mouse.click(x + 0.45 * width, y + down * height);
    await says(/second point/);
    await page.mouse.click(x + 0.6 * width, y + down * height);
    await says(/^≈/);
    const said = await text("#measure-text");
    // From above, to the right, and in one plane.
    const [, length, across, angle] =
      /^≈ ([\d.]+) \S.* · x \+([\d.]+) · y \+0\.0+ · z \+0\.0+ · .* ([\d.]+)°/.exec(said) ?? [];
    assert.ok(Number(length) > 0.01, said);
    assert.equal(across, length);
    assert.equal(Number(angle), 0);
  }
  assert.equal(await page.locator(".pin").count(), 0);
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#measure-text").isHidden());
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
