// Which files are compared: those that a link names, and none that nobody chose.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { after, before, test } from "node:test";
import { modelFile, planes } from "../support/models.mjs";
import { open } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open();
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const text = (selector) => page.locator(selector).textContent();
const named = (side) => text(`#shape-${side} option:checked`);
const [low, high] = [modelFile("low.json", planes(0)), modelFile("high.json", planes(0.25))];
const hash = ({ buffer }) => createHash("sha256").update(buffer).digest("hex");

test("a single file that is dropped is compared with no example", async () => {
  await page.setInputFiles("#file-both", [low]);
  await page.locator('#result[data-state="lone"]').waitFor();
  assert.match(await text("#interval"), /drop the one to compare it with/);
  assert.deepEqual(await Promise.all(["a", "b"].map(named)), ["low.json", "no file yet"]);
  assert.deepEqual([await text("#distance"), await text("#badge")], ["–", ""]);
  assert.ok(await page.locator("#legend").isHidden());
  await opened.screenshot("lone");
  await page.reload();
  await page.locator('#result[data-state="lone"]').waitFor();
  await opened.until("done", () => page.setInputFiles("#file-both", [high]));
  assert.deepEqual(await Promise.all(["a", "b"].map(named)), ["low.json", "high.json"]);
  assert.equal(await text("#distance"), "0.25000");
});

test("a third file is said to be left out", async () => {
  const third = modelFile("third.json", planes(1));
  await opened.until("done", () => page.setInputFiles("#file-both", [low, high, third]));
  assert.match(await text("#files-note"), /third\.json was not opened/);
  await opened.until("done", () => page.setInputFiles("#file-both", [low, high]));
  assert.ok(await page.locator("#files-note").isHidden());
});

test("rows name the files that are read, and those before again where one cannot be read", async () => {
  await page.evaluate(() => {
    window.rows = [];
    const loading = document.getElementById("loading");
    new MutationObserver(() => {
      if (loading.hidden) return;
      queueMicrotask(() =>
        window.rows.push(document.getElementById("shape-a").selectedOptions[0].textContent),
      );
    }).observe(loading, { attributes: true });
  });
  await page.setInputFiles("#file-a", { ...low, name: "broken.json", buffer: Buffer.from("{") });
  await page.locator("#error").waitFor();
  assert.ok((await page.evaluate(() => window.rows)).includes("broken.json"));
  assert.equal(await named("a"), "low.json");
});

test("a link names files and their hashes, and another browser asks for them before it shows anything", async () => {
  await page.locator("#limit").fill("0.2");
  await page.waitForFunction(
    (wanted) => location.hash.includes(wanted) && location.hash.includes("limit=0.2"),
    hash(high),
  );
  const link = page.url();
  const parameters = new URLSearchParams(new URL(link).hash.slice(1));
  assert.deepEqual(
    ["file-a", "sha256-a", "file-b", "sha256-b", "limit"].map((name) => parameters.get(name)),
    ["low.json", hash(low), "high.json", hash(high), "0.2"],
  );
  const other = await (await page.context().browser().newContext()).newPage();
  await other.goto(link);
  await other.locator('#result[data-state="asked"]').waitFor();
  const asked = () => other.locator("#asked").textContent();
  assert.match(await asked(), /low\.json.*high\.json/);
  assert.ok((await asked()).includes(hash(low).slice(0, 12)));
  const shown = await Promise.all(
    ["#distance", "#badge"].map((selector) => other.locator(selector).textContent()),
  );
  assert.deepEqual(shown, ["–", ""]);
  const rows = () =>
    other.locator("#shape-a option:checked, #shape-b option:checked").allTextContents();
  assert.deepEqual(await rows(), ["not here yet: low.json", "not here yet: high.json"]);
  // A file of that name with another content is another file.
  await other.setInputFiles("#file-both", [modelFile("high.json", planes(0.5)), low]);
  await other.locator("#asked-problem", { hasText: "high.json has another content" }).waitFor();
  assert.doesNotMatch(await other.locator("#asked-text").textContent(), /low\.json/);
  assert.deepEqual(await rows(), ["low.json", "not here yet: high.json"]);
  await other.setInputFiles("#file-both", [{ ...high, name: "renamed.json" }]);
  await other.locator('#result[data-state="done"]').waitFor();
  assert.ok(await other.locator("#asked").isHidden());
  assert.equal(await other.locator("#badge").textContent(), "FAIL");
  assert.equal(await other.locator("#limit").inputValue(), "0.2");
  await other.context().close();
});

test("windows with other files keep their own over a reload", async () => {
  const context = await page.context().browser().newContext();
  const third = modelFile("third.json", planes(1));
  const windows = [];
  for (const file of [high, third]) {
    const one = await context.newPage();
    await one.goto(new URL("/#symmetric=&deviation=", page.url()).href);
    await one.locator('#result[data-state="done"]').waitFor();
    await one.setInputFiles("#file-both", [low, file]);
    await one.waitForFunction((wanted) => location.hash.includes(wanted), hash(file));
    windows.push(one);
  }
  // The second one's files were opened last.
  const [first] = windows;
  await first.reload();
  await first.locator('#result[data-state="done"]').waitFor();
  assert.equal(await first.locator("#shape-b option:checked").textContent(), "high.json");
  await context.close();
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
