// What the page does no more often than it has to: shaders, drawings, measurements and colours.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn } from "../support/drawn.mjs";
import { open } from "../support/open.mjs";

/** Indices of a drawing of a whole model; the arrow has fewer. */
const WHOLE = 5000;

/** Counts shaders and drawings of models, and notes the requests and replies of measurements. */
const spy = (page) =>
  page.addInitScript((whole) => {
    window.seen = { late: 0, whole: 0, requests: 0, colours: 0 };
    let begun = false;
    const gl = WebGL2RenderingContext.prototype;
    const { clear, drawElements, linkProgram } = gl;
    gl.clear = function (...all) {
      window.seen.whole = 0;
      clear.apply(this, all);
    };
    gl.drawElements = function (mode, count, ...rest) {
      begun = true;
      if (count > whole) window.seen.whole += 1;
      drawElements.call(this, mode, count, ...rest);
    };
    gl.linkProgram = function (program) {
      if (begun) window.seen.late += 1;
      linkProgram.call(this, program);
    };
    globalThis.Worker = class extends Worker {
      set onmessage(listener) {
        super.onmessage = (event) => {
          const { kind, pending, maps = {} } = event.data;
          const last = kind === "measured" && !pending && Object.keys(maps).length > 0;
          if (last) window.seen.colours += 1;
          listener(event);
        };
      }
      postMessage(message, ...rest) {
        if (message.kind === "measure") window.seen.requests += 1;
        super.postMessage(message, ...rest);
      }
    };
  }, WHOLE);

let opened;
let page;

before(async () => {
  opened = await open({ path: "#a=fig5-plane&b=fig5-cylinder&symmetric=", prepare: spy });
  page = opened.page;
  await page.locator('#result[data-state="done"]').waitFor();
  await drawn(page);
});

after(() => opened.close());

const seen = () => page.evaluate(() => ({ ...window.seen }));

test("the shaders of colours are compiled before anything is drawn", async () => {
  assert.ok(await page.locator("#legend").isVisible());
  assert.equal((await seen()).late, 0);
});

test("the colours of a solid model are drawn once a frame, and nothing where nothing changes", async () => {
  await page.selectOption("#show-b", "hidden");
  await drawn(page);
  assert.equal((await seen()).whole, 1);
  await page.evaluate(() => {
    window.seen.whole = 0;
  });
  await drawn(page);
  assert.equal((await seen()).whole, 0);
  await page.selectOption("#show-b", "auto");
});

test("for a verdict that needs a narrower interval the colours are computed once", async () => {
  const before = await seen();
  const { lower, upper } = await opened.data();
  // A little more than the distance: some measurements are needed to decide that.
  const width = Number(upper) - Number(lower);
  assert.ok(width > 1e-4, `${lower} ${upper}`);
  await page.locator("#limit").fill(`${Number(lower) + width / 200}`);
  await page.locator('#verdict[data-verdict="pass"]').waitFor();
  await page.locator('#result[data-state="done"]').waitFor();
  const after = await seen();
  assert.ok(after.requests > before.requests + 1);
  assert.equal(after.colours, before.colours + 1);
});

test("an interval that no tolerance makes narrower is not measured again", async () => {
  const address = page.url().replace(/#.*/, "");
  await page.goto("about:blank");
  await page.goto(`${address}#a=bracket&b=bracket-revised&deviation=`);
  await page.locator('#result[data-state="done"]').waitFor();
  const before = await seen();
  await page.locator("#limit").fill("0.35");
  await page.locator('#verdict[data-verdict="undecided"]').waitFor();
  assert.equal((await seen()).requests, before.requests);
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
