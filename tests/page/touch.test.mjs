// The page by touch, on the screen of a telephone.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { modelFile, planes } from "./support/models.mjs";
import { open } from "./support/open.mjs";

/** The moves of a gesture, about as many as a screen reports in a short one. */
const MOVES = 12;

let opened;
let session;

before(async () => {
  opened = await open({ touch: true, size: { width: 400, height: 800 } });
  const { page } = opened;
  session = await page.context().newCDPSession(page);
  await page.locator('#result[data-state="done"]').waitFor();
  for (const [side, height] of [
    ["a", 0],
    ["b", 0.25],
  ]) {
    const file = modelFile(`${side}.json`, planes(height));
    await opened.until("done", () => page.setInputFiles(`#file-${side}`, file));
  }
});

after(() => opened.close());

/** Moves fingers from points to points, given as parts of an element's box. */
async function gesture(selector, fingers) {
  const { x, y, width, height } = await opened.page.locator(selector).boundingBox();
  const send = (type, touchPoints) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints });
  const at = (part) =>
    fingers.map(([[x0, y0], [x1, y1]], id) => ({
      id,
      x: x + width * (x0 + part * (x1 - x0)),
      y: y + height * (y0 + part * (y1 - y0)),
    }));
  await send("touchStart", at(0));
  for (let move = 1; move <= MOVES; move++) await send("touchMove", at(move / MOVES));
  await send("touchEnd", []);
}

/** The view as a picture, once two in a row are equal. */
async function picture() {
  const { page } = opened;
  let last;
  for (;;) {
    const shot = await page.locator("#canvas").screenshot();
    if (last?.equals(shot)) return shot;
    last = shot;
    await page.waitForTimeout(200);
  }
}

test("one finger turns the view and two move and zoom it, while the page stays where it is", async () => {
  const { page } = opened;
  await page.locator("#canvas").scrollIntoViewIfNeeded();
  const scrolled = await page.evaluate(() => scrollY);
  const pictures = [await picture()];
  for (const fingers of [
    [
      [
        [0.4, 0.4],
        [0.7, 0.6],
      ],
    ],
    [
      [
        [0.45, 0.5],
        [0.3, 0.5],
      ],
      [
        [0.55, 0.5],
        [0.7, 0.5],
      ],
    ],
  ]) {
    await gesture("#canvas", fingers);
    const shot = await picture();
    assert.ok(!pictures.some((earlier) => earlier.equals(shot)), "the view follows the fingers");
    pictures.push(shot);
  }
  assert.equal(await page.evaluate(() => scrollY), scrolled);
  await opened.screenshot("touch");
});

test("a tap pins a point, and a second one on its button removes it", async () => {
  const { page } = opened;
  await page.selectOption("#show-b", "hidden");
  await page.selectOption("#direction", "top");
  await page.locator("#canvas").scrollIntoViewIfNeeded();
  const { x, y, width, height } = await page.locator("#canvas").boundingBox();
  await page.touchscreen.tap(x + 0.5 * width, y + 0.55 * height);
  const pin = page.locator(".pin");
  await pin.waitFor();
  assert.match(await pin.textContent(), /0\.25000/);
  await pin.locator("button").tap();
  assert.equal(await pin.count(), 0);
});

test("a slider follows a finger, and the distance follows the slider", async () => {
  const { page } = opened;
  await page.locator("#move-z").scrollIntoViewIfNeeded();
  const before = Number((await opened.data()).computed);
  await opened.until("done", () =>
    gesture("#move-z", [
      [
        [0.5, 0.5],
        [0.7, 0.5],
      ],
    ]),
  );
  assert.notEqual(await page.locator("#move-z").inputValue(), "0");
  assert.notEqual(Number((await opened.data()).computed), before);
});

test("what fills the view fills it in every shape of the window, and after the context was lost", async () => {
  const { page } = opened;
  await page.locator("#fit").click();
  const before = await picture();
  await page.setViewportSize({ width: 1200, height: 800 });
  const wide = await picture();
  await page.locator("#fit").click();
  assert.ok((await picture()).equals(wide));
  await page.setViewportSize({ width: 400, height: 800 });
  await page.locator("#canvas").scrollIntoViewIfNeeded();
  assert.ok((await picture()).equals(before));
  await page.evaluate(async () => {
    const canvas = document.getElementById("canvas");
    const loss = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    const event = (name) =>
      new Promise((resolve) => canvas.addEventListener(name, resolve, { once: true }));
    const lost = event("webglcontextlost");
    loss.loseContext();
    await lost;
    const restored = event("webglcontextrestored");
    // A context is restored in a task of its own.
    setTimeout(() => loss.restoreContext());
    await restored;
  });
  assert.ok((await picture()).equals(before));
});

test("nothing was thrown on the page", () => assert.deepEqual(opened.errors, []));
