// Counting of pixels in pictures of the view.

/** What lies over the view and has colours of its own. */
const OVER = "#label, .end, #tools, #legend, #axes, #cut, #pins, #hover { visibility: hidden }";

/** The number of pixels of the view for which `holds`, an expression of r, g and b, is true. */
export async function countPixels(page, holds) {
  await page.waitForTimeout(500);
  const image = (await page.locator("#canvas").screenshot({ style: OVER })).toString("base64");
  return page.evaluate(
    async ([image, holds]) => {
      const bitmap = await createImageBitmap(
        await (await fetch(`data:image/png;base64,${image}`)).blob(),
      );
      const { width, height } = bitmap;
      const context = new OffscreenCanvas(width, height).getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, width, height);
      const test = new Function("r", "g", "b", `return ${holds}`);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        count += Number(test(data[at], data[at + 1], data[at + 2]));
      }
      return count;
    },
    [image, holds],
  );
}
