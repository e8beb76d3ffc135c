import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { file, modelFile, planes } from "../support/models.mjs";
import { open } from "../support/open.mjs";

let opened;

before(async () => {
  opened = await open();
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** Drops files with these names and texts; returns whether the browser's default action was prevented. */
const drop = (target, part, ...files) =>
  opened.page.locator(target).evaluate(
    (target, [part, files]) => {
      const dataTransfer = new DataTransfer();
      for (const [name, text] of files) dataTransfer.items.add(new File([text], name));
      const { left, top, width, height } = target.getBoundingClientRect();
      const at = { clientX: left + part * width, clientY: top + height / 2 };
      return ["dragover", "drop"].every((type) => {
        const options = { dataTransfer, bubbles: true, cancelable: true, ...at };
        return !target.dispatchEvent(new DragEvent(type, options));
      });
    },
    [part, files],
  );

const chosen = (list) => opened.page.locator(`${list} option:checked`).textContent();

/** Everything that a user sees of the models and their distance. */
const seen = async () => ({
  data: await opened.data(),
  distance: await opened.page.locator("#distance").textContent(),
  interval: await opened.page.locator("#interval").textContent(),
  pair: await chosen("#preset"),
  a: await chosen("#shape-a"),
  b: await chosen("#shape-b"),
  x: await opened.page.locator("#move-x").inputValue(),
  exact: await opened.page.locator("#move-x-exact").inputValue(),
  label: await opened.page.locator("#label").isVisible(),
});

test("a file opened as A makes an own pair, at the file's position", async () => {
  const { page } = opened;
  await opened.until("done", () => page.selectOption("#preset", { label: "Torus and moved copy" }));
  await opened.until("done", () => page.setInputFiles("#file-a", modelFile("low.json", planes(0))));
  assert.equal(await chosen("#preset"), "own pair");
  assert.equal(await chosen("#shape-a"), "low.json");
  assert.equal(await page.locator("#move-x-exact").inputValue(), "0");
});

test("planes are dropped on the halves of the view; the slider moves A, and the arrow follows", async () => {
  const { page } = opened;
  await opened.until("done", () => page.selectOption("#preset", { label: "Torus and moved copy" }));
  const low = ["low.json", JSON.stringify(planes(0))];
  const high = ["high.json", JSON.stringify(planes(3))];
  // Alone it is compared with no example.
  await drop("#stage", 0.25, low);
  await page
    .locator("#shape-a option:checked", { hasText: "low.json" })
    .waitFor({ state: "attached" });
  await opened.until("done", () => drop("#stage", 0.75, high));
  assert.equal(await chosen("#shape-b"), "high.json");
  await opened.until("done", () => page.locator("#move-z").fill("0.5"));
  const diagonal = Math.hypot(2, 2);
  const { computed, a, b } = await opened.data();
  assert.ok(Math.abs(Number(computed) - (3 - 0.5 * diagonal)) < 1e-4, computed);
  assert.ok(Math.abs(Number(a.split(" ")[2]) - 0.5 * diagonal) < 1e-4, a);
  assert.equal(Number(b.split(" ")[2]), 3);
  await page.locator("#label").waitFor();

  await opened.until("done", () => drop("#model-b", 0.5, low));
  assert.equal(await chosen("#shape-b"), "low.json");
  await opened.until("done", () => drop("#stage", 0.9, high, low));
  assert.deepEqual([await chosen("#shape-a"), await chosen("#shape-b")], ["high.json", "low.json"]);
  assert.equal((await seen()).distance, "3.00000");
});

test("a file dropped outside all targets changes nothing, and is not opened by the browser", async () => {
  await opened.page.locator("#label").waitFor();
  const before = await seen();
  const url = opened.page.url();
  assert.ok(await drop("#result", 0.5, ["low.json", JSON.stringify(planes(7))]));
  await opened.page.waitForTimeout(500);
  assert.deepEqual(await seen(), before);
  assert.equal(opened.page.url(), url);
  assert.ok(await opened.page.locator("#drop").isHidden());
});

/** Asserts that opening a file fails with this code, and leaves the models and their result unchanged. */
async function fails(code, name, open) {
  const { page } = opened;
  await opened.until("done", () => page.selectOption("#preset", { label: "Glass and bottle" }));
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.3"));
  await page.locator("#label").waitFor();
  const before = await seen();
  await open();
  const error = page.locator(`#error[data-code="${code}"]`);
  await error.waitFor();
  const text = await error.textContent();
  assert.ok(text.endsWith(`(${code})`) && text.includes(name), text);
  assert.deepEqual(await seen(), before);
  await opened.screenshot("error");
  // The models can still be measured, and that removes the error.
  await opened.until("done", () => page.locator("#move-x-exact").fill("0.2"));
  assert.ok(await page.locator("#error").isHidden());
}

const weightless = planes(0);
weightless.surfaces[0].ctrl[1][0][3] = 0;
for (const [text, code] of [
  ["not a model", "FORMAT_UNSUPPORTED"],
  ["{}", "JSON_SHAPE"],
  [JSON.stringify(weightless), "WEIGHT_NOT_POSITIVE"],
]) {
  test(`a broken file changes nothing, and is reported with ${code}`, () =>
    fails(code, "broken.json", () =>
      opened.page.setInputFiles("#file-b", file("broken.json", text)),
    ));
}

test("a file that was removed before it is read changes nothing", async () => {
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  const path = join(folder, "gone.json");
  writeFileSync(path, JSON.stringify(planes(0)));
  const { page } = opened;
  await page.evaluate(() => {
    const input = document.createElement("input");
    input.type = "file";
    input.id = "gone";
    document.body.append(input);
  });
  await page.setInputFiles("#gone", path);
  rmSync(folder, { recursive: true });
  await fails("FILE_UNREADABLE", "gone.json", () =>
    page.evaluate(() => {
      const { files } = document.getElementById("gone");
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(files[0]);
      document
        .getElementById("model-a")
        .dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }),
  );
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
