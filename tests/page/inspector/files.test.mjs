// Files of users: meshes and scans, kept over a reload, and a load that is stopped.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { file, modelFile, planes, stepSquares } from "../support/models.mjs";
import { open } from "../support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open();
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

/** A square of side 2 at a height as STL, in two triangles. */
const stl = (height) => {
  const facet = (corners) =>
    `facet normal 0 0 1\nouter loop\n${corners.map(([x, y]) => `vertex ${x} ${y} ${height}`).join("\n")}\nendloop\nendfacet\n`;
  const [a, b, c, d] = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ];
  return file(
    "square.stl",
    `solid square\n${facet([a, b, c])}${facet([a, c, d])}endsolid square\n`,
  );
};

test("a mesh is compared with a surface, and both are painted", async () => {
  await opened.until("done", () =>
    page.setInputFiles("#file-a", modelFile("a.json", planes(0.25))),
  );
  await opened.until("done", () => page.setInputFiles("#file-b", stl(0)));
  await opened.until("done", () => page.locator("#deviation").check());
  const { lower, upper } = await opened.data();
  assert.ok(Number(lower) <= 0.25 && 0.25 <= Number(upper), `${lower} ${upper}`);
  const { "A: mean": a, "B: mean": b } = await opened.texts("#statistics");
  assert.deepEqual([a, b], ["≈ 0.25000", "≈ 0.25000"]);
  await opened.screenshot("mesh");
});

test("a scan is drawn as points in its colours, and counted", async () => {
  const points = ["-0.5 0 0.25", "0.5 0 0.25", "0 0.5 0.5", "0 -0.5 0.25"].join("\n");
  await page.locator("#limit").fill("0.1");
  await opened.until("done", () => page.setInputFiles("#file-b", file("scan.xyz", points)));
  assert.match(
    await page.locator("#beyond-limit").textContent(),
    /B: ≈ 25\.0 % of the points are beyond \(1 of 4\)/,
  );
  await opened.screenshot("scan");
});

test("files are kept over a reload with their options, until they are forgotten", async () => {
  await page.waitForTimeout(400);
  await page.reload();
  await page
    .locator("#shape-b option:checked", { hasText: "scan.xyz" })
    .waitFor({ state: "attached" });
  await page.locator('#result[data-state="done"]').waitFor();
  assert.equal(await page.locator("#shape-a option:checked").textContent(), "a.json");
  assert.equal(await page.locator("#limit").inputValue(), "0.1");
  await page.locator("#forget").click();
  await page.waitForTimeout(300);
  await page.reload();
  await page.locator('#result[data-state="done"]').waitFor();
  assert.equal(await page.locator("#shape-a option:checked").textContent(), "Bracket");
});

test("what an address has that the page does not take changes nothing, and is named", async () => {
  const url = new URL(page.url());
  const note = page.locator("#files-note");
  const own = "own-limits=a3:0.1/0.2,a4:0.";
  for (const [parameters, names] of [
    ["camera=5,-5,5,0,0,0&below=0.5", ""],
    ["camera=1,2,3", "camera"],
    ["camera=a,b,c,d,e,f&limit=abc&steps=4", "camera, limit, steps"],
    ["camera=0,0,0,0,0,0&a=nothing", "camera, a"],
    [
      `annotations=${encodeURIComponent('[["')}&measures=1&${own}`,
      "annotations, measures, own-limits",
    ],
    ["colors=3", "colors"],
  ]) {
    url.hash = `symmetric=&deviation=&${parameters}`;
    await page.goto("about:blank");
    await page.goto(url.href);
    await page.locator('#result[data-state="done"]').waitFor();
    assert.equal(await page.locator("#scale-steps").inputValue(), "0");
    assert.equal(await note.isVisible(), names !== "");
    if (names === "") continue;
    assert.ok((await note.textContent()).includes(`not all of ${names} is shown`), parameters);
  }
});

/** Notes what the page says of a load, and the result beside it, until it ends. */
const noteLoading = () =>
  page.evaluate(() => {
    window.noted = [];
    const loading = document.getElementById("loading");
    new MutationObserver(() => {
      const percent = /reading… (\d+) %/.exec(loading.textContent)?.[1];
      const label = document.getElementById("label");
      if (percent === undefined || loading.hidden) return;
      // The result goes with the first faces drawn, in the same task.
      setTimeout(() =>
        window.noted.push({
          percent: Number(percent),
          distance: document.getElementById("distance").textContent,
          label: label.checkVisibility(),
        }),
      );
    }).observe(loading, { childList: true, characterData: true, subtree: true });
  });

/** A file of many faces, which is read for a second or more. */
const manyFaces = (count) => file("squares.step", stepSquares(count, 50));

test("a file's faces are drawn as they are read, and no result of what they replace", async () => {
  await noteLoading();
  await opened.until("done", () => page.setInputFiles("#file-a", manyFaces(2500)));
  assert.equal(await page.locator("#shape-a option:checked").textContent(), "squares.step");
  const noted = await page.evaluate(() => window.noted);
  assert.ok(noted.length >= 2, JSON.stringify(noted));
  const percents = noted.map(({ percent }) => percent);
  assert.deepEqual(
    percents,
    [...percents].sort((one, other) => one - other),
  );
  for (const { distance, label } of noted) assert.deepEqual([distance, label], ["–", false]);
  assert.ok(await page.locator("#loading").isHidden());
});

test("a file that is stopped while its faces are drawn leaves the models before", async () => {
  await opened.until("done", () => page.selectOption("#preset", { index: 1 }));
  const before = await page.locator("#distance").textContent();
  await page.setInputFiles("#file-b", manyFaces(12_000));
  await page.waitForFunction(() =>
    document.getElementById("loading").textContent.startsWith("reading… "),
  );
  await opened.until("done", () =>
    page.evaluate(() => document.getElementById("load-cancel").click()),
  );
  assert.equal(await page.locator("#distance").textContent(), before);
  assert.ok(!(await page.locator("#shape-b option:checked").textContent()).includes("squares"));
});

test("models are measured again after a file that is broken was chosen instead of one that took long", async () => {
  await opened.until("done", () => page.selectOption("#preset", { index: 1 }));
  const before = await page.locator("#distance").textContent();
  await page.setInputFiles("#file-b", manyFaces(30_000));
  await page.waitForFunction(() =>
    document.getElementById("loading").textContent.startsWith("reading… "),
  );
  // After a second the file that is read is given up, with the worker that reads it: it takes several.
  await page.waitForTimeout(1000);
  await opened.until("done", () =>
    page.setInputFiles("#file-a", file("broken.json", "not a model")),
  );
  assert.ok(!(await page.locator("#shape-b option:checked").textContent()).includes("squares"));
  assert.equal(await page.locator("#error").getAttribute("data-code"), "FORMAT_UNSUPPORTED");
  assert.equal(await page.locator("#distance").textContent(), before);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
