// What a newcomer needs from two files to a report is on the screen, and nothing of it is folded.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { box, model } from "./support/boxes.mjs";
import { modelFile, planes } from "./support/models.mjs";
import { open } from "./support/open.mjs";

let opened;
let page;

before(async () => {
  opened = await open({ path: "", unfolded: false });
  page = opened.page;
  await opened.until("done", () =>
    page.setInputFiles("#file-both", [
      modelFile("a.json", planes(0)),
      modelFile("b.json", planes(0.25)),
    ]),
  );
});

after(() => opened.close());

test("what is allowed is asked for on the first screen, below the files", async () => {
  const field = page.getByRole("spinbutton", { name: "+/−" });
  const { y, height } = await field.boundingBox();
  assert.ok(y + height <= page.viewportSize().height, `${y}`);
  assert.equal(await page.evaluate(() => document.getElementById("panel").scrollTop), 0);
});

test("and of files in a unit whose parts have long names, too", async (context) => {
  const other = await open({ path: "", unfolded: false });
  context.after(() => other.close());
  const long = "Open CASCADE STEP translator 7.9 with the name of a project 17";
  const files = [2, 2.5].map((height, at) =>
    model(`${"ab"[at]}.json`, box(long, [0, 0, 0], [4, 3, height])),
  );
  // The example that the page opens with is measured first.
  await other.page.locator('#result[data-state="done"]').waitFor();
  await other.until("done", () => other.page.setInputFiles("#file-both", files));
  const field = other.page.getByRole("spinbutton", { name: "+/−" });
  const { y, height } = await field.boundingBox();
  assert.ok(y + height <= other.page.viewportSize().height, `${y}`);
  const where = other.page.locator("#where");
  assert.match(await where.textContent(), /project 17/);
  const lines = await where.boundingBox();
  assert.ok(lines.height < 45, `two lines of text: ${lines.height}`);
});

test("a view is added beside the view, which says so, and the report opened without unfolding anything", async () => {
  const add = await page.getByRole("button", { name: "Add to report" }).boundingBox();
  const next = await page.getByRole("button", { name: "Next place" }).boundingBox();
  assert.ok(Math.abs(add.y - next.y) < next.height, "in one row with the way to the worst place");
  await page.getByText("with what is seen now").waitFor();
  await page.getByRole("button", { name: "Add to report" }).click();
  await page.getByRole("button", { name: "Add to report (1)" }).waitFor();
  await page.getByText("1 view in the report").waitFor();
  const { y, height } = await page.getByRole("button", { name: "Open the report" }).boundingBox();
  assert.ok(0 <= y && y + height <= page.viewportSize().height, `the panel shows the report: ${y}`);
  const [report] = await Promise.all([
    page.waitForEvent("popup"),
    page.getByRole("button", { name: "Open the report" }).click(),
  ]);
  await report.getByRole("img", { name: "View 1" }).waitFor();
  await report.close();
});

test("the tools are one row beside the panel on a small laptop", async () => {
  const tops = await page
    .locator("#bar .tool:visible")
    .evaluateAll((tools) =>
      tools
        .map((tool) => tool.getBoundingClientRect())
        .map(({ top, bottom }) => (top + bottom) / 2),
    );
  assert.ok(tops.length >= 16, `${tops.length} tools`);
  assert.ok(Math.max(...tops) - Math.min(...tops) < 10, `${tops}`);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
