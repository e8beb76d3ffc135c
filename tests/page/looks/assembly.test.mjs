// Models of several bodies: moved apart to be looked at, checked by rules, and both as one assembly where A was moved.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { box, model } from "../support/boxes.mjs";
import { drawn } from "../support/drawn.mjs";
import { moduleOf } from "../support/module.mjs";
import { open, PLAIN } from "../support/open.mjs";
import { countPixels } from "../support/pixels.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: `${PLAIN}&paint=a`, size: { width: 1280, height: 800 } });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
});

after(() => opened.close());

const openPair = (a, b) => opened.until("done", () => page.setInputFiles("#file-both", [a, b]));
const reaches = (id, state) => page.locator(`#${id}[data-state="${state}"]`).waitFor();
const text = (selector) => page.locator(selector).textContent();

const rack = () =>
  model(
    "rack.json",
    box("rack / shelf", [0, 0, 0], [4, 4, 1]),
    box("rack / peg", [1, 1, 0.5], [2, 2, 3]),
    box("rack / block", [4, 0, 0], [5, 4, 1]),
  );
const block = () => model("b.json", box("block", [0, 0, 5], [1, 1, 6]));

test("bodies of a model are moved apart, and back", async () => {
  await openPair(rack(), rack());
  await page.selectOption("#direction", "front");
  await drawn(page);
  // What is not the ground of the view.
  const covered = () => countPixels(page, "Math.max(r, g, b) - Math.min(r, g, b) > 30");
  const together = await covered();
  await page.locator("#explode").check();
  await page.locator("#explode-note", { hasText: /to look at only/ }).waitFor();
  await drawn(page);
  await opened.screenshot("exploded");
  assert.ok(await page.locator("#label").isHidden());
  await page.locator("#explode-at").fill("0");
  await drawn(page);
  await page.selectOption("#direction", "front");
  await drawn(page);
  assert.ok(Math.abs((await covered()) - together) < 0.02 * together);
  await page.locator("#explode-at").fill("1");
  // A section goes through bodies where they are drawn, and has no plot of deviations.
  await page.selectOption("#section-axis", "1");
  await drawn(page);
  assert.ok(await page.locator("#cut").isHidden());
  await page.selectOption("#section-axis", "");
});

test("the exploded view is in the address, and ends where a place is shown or measured", async () => {
  await page.waitForFunction(() => new URLSearchParams(location.hash.slice(1)).has("explode"));
  await page.locator("#measure").click();
  assert.ok(!(await page.locator("#explode").isChecked()));
  await page.keyboard.press("Escape");
});

test("a pointer finds the same point of a body, moved apart or not", async () => {
  const { facesOfVertices, displace } = await moduleOf("scene/exploded/displaced.ts");
  const faces = facesOfVertices(
    4,
    [0, 1, 2, 3, 2, 3],
    [
      { firstIndex: 0, indexCount: 3 },
      { firstIndex: 3, indexCount: 3 },
    ],
  );
  assert.deepEqual([...faces], [0, 0, 1, 1]);
  const into = new Float32Array(12);
  displace(new Float32Array(12).fill(1), faces, [undefined, { x: 1, y: 2, z: 3 }], into);
  assert.deepEqual([...into], [1, 1, 1, 1, 1, 1, 2, 3, 4, 2, 3, 4]);
});

test("a body goes with its revision, and away from the middle of all", async () => {
  const { waysOf } = await moduleOf("scene/exploded/offsets.ts");
  const { Box3, Vector3 } = await import("three");
  const at = (x, side) => ({
    side,
    box: new Box3(new Vector3(x, 0, 0), new Vector3(x + 2, 2, 2)),
  });
  const ways = waysOf([at(0, "a"), at(10, "a"), at(0.1, "b"), at(10.1, "b")], 0.5);
  assert.deepEqual(ways[0].toArray(), ways[2].toArray());
  assert.deepEqual(ways[1].toArray(), ways[3].toArray());
  assert.ok(ways[0].x < 0 && ways[1].x > 0 && Math.abs(ways[0].x + ways[1].x) < 0.2);
});

const RULES = {
  intended: [{ a: "rack/peg", b: "rack/shelf" }],
  atLeast: [{ a: "**/peg", b: "**/block", distance: 3 }],
};

const rulesFile = (content) => ({
  name: "rules.json",
  mimeType: "application/json",
  buffer: Buffer.from(content),
});

async function check(of) {
  await page.locator("#check-of").selectOption(of);
  await page.locator("#check").evaluate(({ dataset }) => {
    dataset.state = "awaited";
  });
  await page.locator("#check-start").click();
  await reaches("check", "done");
}

test("rules of a file are listed, judge the check, and are kept in the address", async () => {
  await openPair(rack(), block());
  await check("a");
  assert.match(await text("#check-text"), /^CLASH: 1 of 3 pairs/);
  await page.setInputFiles("#rules-file", rulesFile(JSON.stringify(RULES)));
  await page.locator("#rule-list li").nth(1).waitFor();
  await page.getByText("The rules changed: check again.").waitFor();
  await check("a");
  // The clash is meant, and peg and block are 2 apart where 3 is asked for.
  assert.match(await text("#check-text"), /^BROKEN: 1 rule; .*1 meant$/);
  assert.match(await text("#check-rules-unkept"), /^peg and blockbroken: nearer than 3, 2/);
  await page.waitForFunction(() =>
    new URLSearchParams(location.hash.slice(1)).get("check-rules")?.includes("atLeast"),
  );
  await page.getByRole("button", { name: /Remove the rule apart by 3/ }).click();
  await check("a");
  assert.match(await text("#check-text"), /^CLEAN: 3 pairs, .*1 meant$/);
  await opened.screenshot("rules");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#rules-save").click(),
  ]);
  const saved = JSON.parse(readFileSync(await download.path(), "utf8"));
  assert.deepEqual(saved, { intended: RULES.intended });
});

test("a clash is said to be meant where it is listed", async () => {
  await page.locator("#rules-clear").click();
  await check("a");
  await page.getByRole("button", { name: "The clash of" }).click();
  assert.equal(await page.locator("#rule-list li").count(), 1);
  await check("a");
  assert.match(await text("#check-text"), /^CLEAN: 3 pairs, .*1 meant$/);
  await page.locator("#rules-clear").click();
});

test("what is no rule is refused, and says why", async () => {
  for (const [content, why] of [
    ["{", /rules\.json: /],
    ['{"meant": []}', /no list meant/],
    ['{"intended": [{"a": "x"}]}', /intended, rule 1 has no names a and b/],
    ['{"atLeast": [{"a": "x", "b": "y"}]}', /no distance/],
    ['{"mustTouch": [{"a": "x", "b": "y", "c": 1}]}', /has c/],
  ]) {
    await page.setInputFiles("#rules-file", rulesFile(content));
    await page.locator("#rules-problem", { hasText: why }).waitFor();
    assert.equal(await page.locator("#rule-list li").count(), 0);
  }
  // A pattern of no body would let everything pass.
  const nobody = JSON.stringify({ intended: [{ a: "no/body", b: "rack/peg" }] });
  await page.setInputFiles("#rules-file", rulesFile(nobody));
  await page.locator("#rule-list li").waitFor();
  await page.locator("#check-start").click();
  await page.locator("#check-text", { hasText: /no\/body/ }).waitFor();
  await page.locator("#rules-clear").click();
});

test("both files are one assembly, A where it was moved to", async () => {
  await openPair(rack(), block());
  await check("both");
  assert.doesNotMatch(await text("#check-pairs"), /B block/);
  // By 2.5 the peg, up to 3, reaches 0.5 into the block, which is over [0, 1]² and begins at 5.
  await opened.until("done", () => page.locator("#move-z-exact").fill("2.5"));
  await opened.until("done", () => page.locator("#move-x-exact").fill("-1"));
  await opened.until("done", () => page.locator("#move-y-exact").fill("-1"));
  await check("both");
  const rows = await page.locator("#check-pairs li").allTextContents();
  const clash = rows.find((row) => /^clashA peg and B block/.test(row));
  assert.match(clash ?? rows.join("; "), /depth 0\.5\d* mm, volume 0\.5/);
  // A turn by 90° about the middle, (2.5, 2, 1.5), takes the peg from there.
  await opened.until("done", () => page.locator("#turn-z-exact").fill("90"));
  await check("both");
  const turned = await page.locator("#check-pairs li").allTextContents();
  assert.ok(!turned.some((row) => /^clashA peg and B block/.test(row)), turned.join("; "));
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
