// Counting of pixels in pictures of the view.
import { drawn } from "./drawn.mjs";

/** What lies over the view and has colours of its own. */
const OVER =
  "#label, .end, #tools, #legend, #axes, #cut, #foot, #pins, #hover { visibility: hidden }";

/** The number of pixels of the view, or of the part beneath an element, for which `holds`, an expression of r, g and b, is true. */
export async function countPixels(page, holds, selector = "#canvas") {
  const rows = await pixelRows(page, holds, selector);
  return rows.reduce((sum, { count }) => sum + count, 0);
}

/** The rows of the view, from the top, in which there are such pixels, with their numbers. */
export async function pixelRows(page, holds, selector = "#canvas") {
  await drawn(page);
  const beneath = await page.locator(selector).evaluate((node) => {
    const { left, top, right, bottom } = node.getBoundingClientRect();
    const { x, y } = document.getElementById("canvas").getBoundingClientRect();
    return { left: left - x, top: top - y, right: right - x, bottom: bottom - y };
  });
  const image = (await page.locator("#canvas").screenshot({ style: OVER })).toString("base64");
  return page.evaluate(
    async ([image, holds, { left, top, right, bottom }]) => {
      const bitmap = await createImageBitmap(
        await (await fetch(`data:image/png;base64,${image}`)).blob(),
      );
      const { width, height } = bitmap;
      const context = new OffscreenCanvas(width, height).getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, width, height);
      const test = new Function("r", "g", "b", `return ${holds}`);
      const rows = [];
      for (let y = Math.ceil(top); y < Math.min(height, bottom); y++) {
        let count = 0;
        for (let x = Math.ceil(left); x < Math.min(width, right); x++) {
          const at = 4 * (y * width + x);
          count += Number(test(data[at], data[at + 1], data[at + 2]));
        }
        if (count > 0) rows.push({ y, count });
      }
      return rows;
    },
    [image, holds, beneath],
  );
}
