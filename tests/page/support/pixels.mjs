// Counting of pixels in pictures of the view.
import { drawn } from "./drawn.mjs";

/** What lies over the view and has colours of its own, and the ring of the focus. */
const OVER =
  "#label, .end, #tip, #wipe-line, #context, #legend, #axes, #cut, #foot, #pins, #hover { visibility: hidden } #canvas { outline: none !important }";

/** The number of pixels of the view for which `holds`, an expression of r, g and b, is true. */
export async function countPixels(page, holds) {
  const [count] = await countEach(page, holds, ["#canvas"]);
  return count;
}

/** The numbers of such pixels of the view beneath elements, from one picture. */
export async function countEach(page, holds, selectors) {
  const all = await rowsBeneath(page, holds, selectors);
  return all.map((rows) => rows.reduce((sum, { count }) => sum + count, 0));
}

/** The rows of the view, from the top, in which there are such pixels, with their numbers. */
export async function pixelRows(page, holds) {
  const [rows] = await rowsBeneath(page, holds, ["#canvas"]);
  return rows;
}

async function rowsBeneath(page, holds, selectors) {
  await drawn(page);
  const parts = await page.evaluate((selectors) => {
    const { x, y } = document.getElementById("canvas").getBoundingClientRect();
    return selectors
      .map((selector) => document.querySelector(selector).getBoundingClientRect())
      .map(({ left, top, right, bottom }) => {
        return { left: left - x, top: top - y, right: right - x, bottom: bottom - y };
      });
  }, selectors);
  const image = (await page.locator("#canvas").screenshot({ style: OVER })).toString("base64");
  return page.evaluate(
    async ([image, holds, parts]) => {
      const bitmap = await createImageBitmap(
        await (await fetch(`data:image/png;base64,${image}`)).blob(),
      );
      const { width, height } = bitmap;
      const context = new OffscreenCanvas(width, height).getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, width, height);
      const test = new Function("r", "g", "b", `return ${holds}`);
      return parts.map(({ left, top, right, bottom }) => {
        const rows = [];
        for (let y = Math.max(0, Math.ceil(top)); y < Math.min(height, bottom); y++) {
          let count = 0;
          for (let x = Math.max(0, Math.ceil(left)); x < Math.min(width, right); x++) {
            const at = 4 * (y * width + x);
            count += Number(test(data[at], data[at + 1], data[at + 2]));
          }
          if (count > 0) rows.push({ y, count });
        }
        return rows;
      });
    },
    [image, holds, parts],
  );
}
