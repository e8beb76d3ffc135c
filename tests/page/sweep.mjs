// The page of experiments: chosen, run, and its table read.
import { readFileSync } from "node:fs";

/** What the fields are called in the page. */
const METHODS = '#methods input[type="checkbox"]:enabled';

/** Chooses a pair or, given two files, own ones; and of the methods only these and the certified one. */
export async function choose(page, { pair, files, methods = [], ...fields }) {
  if (files !== undefined) {
    await page.setInputFiles("#file-a", files[0]);
    await page.setInputFiles("#file-b", files[1]);
  } else await page.selectOption("#pair", pair);
  for (const box of await page.locator(METHODS).all()) await box.uncheck();
  for (const name of methods) await page.locator(`[data-method="${name}"] input`).check();
  for (const [field, value] of Object.entries(fields)) await page.selectOption(`#${field}`, value);
}

export const state = (page, name) => page.locator(`#sweep[data-state="${name}"]`).waitFor();

export async function run(page) {
  await page.locator("#run").click();
  await state(page, "done");
}

/** The table that the page saves, with its name. */
export async function saved(page) {
  const download = page.waitForEvent("download");
  await page.locator("#save").click();
  const file = await download;
  return { name: file.suggestedFilename(), ...parsed(readFileSync(await file.path(), "utf8")) };
}

/** The columns and rows of a table without quotes; numbers are numbers. */
export function parsed(text) {
  const [header, ...lines] = text.trimEnd().split("\n");
  const columns = header.split(",");
  const value = (cell) => (cell === "" || Number.isNaN(Number(cell)) ? cell : Number(cell));
  const rows = lines.map((line) =>
    Object.fromEntries(line.split(",").map((cell, index) => [columns[index], value(cell)])),
  );
  return { columns, rows };
}

/** Pixels of a method's colour in a panel, around the x at this part of the way from end to end. */
export const painted = (page, panel, method, part) =>
  page.evaluate(
    ({ panel, method, part }) => {
      const swatch = document.querySelector(`[data-method="${method}"] i`);
      const wanted = getComputedStyle(swatch).color.match(/\d+/g).map(Number);
      const canvas = document.querySelector(`#plot-${panel} canvas`);
      const [all, over] = [canvas, document.querySelector(`#plot-${panel} .u-over`)].map((one) =>
        one.getBoundingClientRect(),
      );
      // The axis is a little longer than the way, at both ends.
      const room = 0.03 / 1.06;
      const x = over.left - all.left + over.width * (room + part * (1 - 2 * room));
      const scale = canvas.width / all.width;
      const [left, top] = [scale * (x - 3), scale * (over.top - all.top)].map(Math.round);
      const [width, height] = [6 * scale, over.height * scale].map(Math.round);
      const { data } = canvas.getContext("2d").getImageData(left, top, width, height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        const near = wanted.every((value, channel) => Math.abs(data[at + channel] - value) < 12);
        if (near && data[at + 3] > 200) count++;
      }
      return count;
    },
    { panel, method, part },
  );
