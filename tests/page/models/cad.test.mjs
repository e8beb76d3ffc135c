// CAD files on the page: their readers are fetched when the first such file comes.
import assert from "node:assert/strict";
import { existsSync, readdirSync } from "node:fs";
import { after, before, test } from "node:test";
import { modelFile, planes } from "../support/models.mjs";
import { open } from "../support/open.mjs";

const shared = (name) => new URL(`../../../../shared/models/${name}`, import.meta.url).pathname;

let opened;
const fetched = [];

before(async () => {
  opened = await open({
    prepare: (page) => page.on("request", (request) => fetched.push(request.url())),
  });
  await opened.page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const openFile = (side, path) =>
  opened.until("done", () => opened.page.setInputFiles(`#file-${side}`, path));

/** The wasm files of readers that were fetched. */
const readers = () => fetched.flatMap((url) => readerOf(url));
const readerOf = (file) => /(occt|rhino|readers)[^/]*\.wasm/.exec(file)?.[1] ?? [];

/** The readers that are files of their own: a page built without LTO has ours in the core. */
const apart = readdirSync(new URL("../../../www/dist/assets", import.meta.url)).flatMap(readerOf);

test("no reader is fetched before a file needs it", () => {
  assert.deepEqual(readers(), []);
});

for (const [side, name, format, unit, needed] of [
  ["a", "step/linkrods.step.gz", "STEP", "mm", ["readers"]],
  ["b", "iges/bearing.iges.gz", "IGES", "mm", ["readers"]],
  ["b", "3dm/v2_T-Joint2.3dm.gz", "Rhino 3DM", "mm", ["readers", "rhino"]],
]) {
  test(`${name} shows its format, faces and unit`, async (context) => {
    if (!existsSync(shared(name))) {
      context.skip(`there is no ../shared/models/${name}`);
      return;
    }
    await openFile(side, shared(name));
    const note = await opened.page.locator(`#note-${side} summary`).textContent();
    assert.match(note, new RegExp(`^${format} · [0-9,]+ faces · ${unit}`));
    assert.deepEqual(
      readers(),
      needed.filter((reader) => apart.includes(reader)),
    );
    await opened.screenshot(`cad-${side}`);
  });
}

test("a file in another format is refused with the formats that are read", async () => {
  const { page } = opened;
  await page.setInputFiles("#file-a", {
    name: "part.dwg",
    mimeType: "application/acad",
    buffer: Buffer.from("AC1027\n"),
  });
  const error = page.locator('#error[data-code="FORMAT_UNSUPPORTED"]');
  await error.waitFor();
  assert.match(await error.textContent(), /part\.dwg.*STEP, IGES/);
});

test("a model of another unit is converted, and the page says so", async () => {
  const { page } = opened;
  // 25.4 mm above A is 1 inch.
  await openFile("a", modelFile("a.json", { unit: 0.001, ...planes(25.4) }));
  await openFile("b", modelFile("b.json", { unit: 0.0254, ...planes(0) }));
  assert.match(
    await page.locator("#units-differ").textContent(),
    /B in inches: B is converted to mm/,
  );
  const { lower, upper } = await opened.data();
  assert.ok(Number(lower) <= 25.4 + 1e-12 && 25.4 - 1e-12 <= Number(upper), `${lower} ${upper}`);
  assert.equal(await page.locator("#unit").textContent(), "mm");
  await openFile("b", modelFile("b.json", { unit: 0.001, ...planes(0) }));
  assert.ok(await page.locator("#units-differ").isHidden());
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
