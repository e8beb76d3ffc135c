// A slider dragged with the mouse, while what the page shows is recorded.

/** Milliseconds between two moves of the mouse: a display's frame. */
const FRAME = 16;
/** Milliseconds of a drag at most: the machine may be busy with other things. */
const LONGEST = 40_000;

/** Moves from one end of the way to the other. */
const MOVES = 60;

/**
 * Drags the slider to and fro between two parts of its length until `wanted`
 * different distances were shown, or for 40 s, and returns what the read-out
 * said meanwhile, the mouse still moving: the results, and the heights that
 * parts of the panel stood at.
 */
export async function drag(page, slider, wanted, { from = 0.52, to = 0.6 } = {}) {
  const box = await page.locator(slider).boundingBox();
  const move = (part) => page.mouse.move(box.x + box.width * part, box.y + box.height / 2);
  await move(from);
  await page.mouse.down();
  await page.evaluate(() => {
    const result = document.getElementById("result");
    const seen = { results: [], heights: {} };
    const note = () => {
      const { state, computed, lower, upper } = result.dataset;
      const last = seen.results.at(-1)?.computed;
      if ((state === "live" || state === "done") && computed !== last) {
        const text = document.getElementById("distance").textContent;
        seen.results.push({ computed, lower: Number(lower), upper: Number(upper), text });
      }
      for (const id of ["preset", "facts"]) {
        seen.heights[`${id} at ${document.getElementById(id).getBoundingClientRect().top}`] = true;
      }
    };
    note();
    seen.results.length = 0;
    const observer = new MutationObserver(note);
    observer.observe(result, { attributes: true });
    window.dragged = { seen, observer };
  });
  const begin = Date.now();
  const shown = () => page.evaluate(() => window.dragged.seen.results.length);
  for (let step = 1; Date.now() - begin < LONGEST && (await shown()) < wanted; step++) {
    const part = 1 - Math.abs(1 - ((step / MOVES) % 2));
    await move(from + (to - from) * part);
    await page.waitForTimeout(FRAME);
  }
  const { results, heights } = await page.evaluate(() => {
    window.dragged.observer.disconnect();
    return window.dragged.seen;
  });
  const perSecond = (results.length * 1000) / (Date.now() - begin);
  await page.mouse.up();
  return { results, heights: Object.keys(heights), perSecond };
}
