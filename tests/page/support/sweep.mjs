// Helpers for the page of experiments: choosing, running, and reading the table.
import { readFileSync } from "node:fs";

/** The check boxes of the methods that can be left out. */
const METHODS = '#methods input[type="checkbox"]:enabled';

/** Chooses a pair, or two files, and only these methods in addition to the certified one. */
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

/** Returns the table that the page saves, with the file's name. */
export async function saved(page) {
  const download = page.waitForEvent("download");
  await page.locator("#save").click();
  const file = await download;
  return { name: file.suggestedFilename(), ...parsed(readFileSync(await file.path(), "utf8")) };
}

/** Parses a table without quotes into columns and rows; cells that are numbers become numbers. */
export function parsed(text) {
  const [header, ...lines] = text.trimEnd().split("\n");
  const columns = header.split(",");
  const value = (cell) => (cell === "" || Number.isNaN(Number(cell)) ? cell : Number(cell));
  const rows = lines.map((line) =>
    Object.fromEntries(line.split(",").map((cell, index) => [columns[index], value(cell)])),
  );
  return { columns, rows };
}

/** Counts the pixels of a method's colour in a panel, near the x at this fraction of the range of positions. */
export const painted = (page, panel, method, part) =>
  page.evaluate(
    ({ panel, method, part }) => {
      const swatch = document.querySelector(`[data-method="${method}"] i`);
      const expected = getComputedStyle(swatch).color.match(/\d+/g).map(Number);
      const canvas = document.querySelector(`#plot-${panel} canvas`);
      const [all, over] = [canvas, document.querySelector(`#plot-${panel} .u-over`)].map((one) =>
        one.getBoundingClientRect(),
      );
      // The axis extends a little beyond the positions at both ends.
      const margin = 0.03 / 1.06;
      const x = over.left - all.left + over.width * (margin + part * (1 - 2 * margin));
      const scale = canvas.width / all.width;
      const [left, top] = [scale * (x - 3), scale * (over.top - all.top)].map(Math.round);
      const [width, height] = [6 * scale, over.height * scale].map(Math.round);
      const { data } = canvas.getContext("2d").getImageData(left, top, width, height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        const near = expected.every((value, channel) => Math.abs(data[at + channel] - value) < 12);
        if (near && data[at + 3] > 200) count++;
      }
      return count;
    },
    { panel, method, part },
  );
