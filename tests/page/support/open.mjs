// Serves the built page and opens it in headless Chromium.
import { after, before } from "node:test";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { launchOptions } from "../../../scripts/test/browser.mjs";
import { drawn } from "./drawn.mjs";
import { saveScreenshot } from "./screenshots.mjs";

/**
 * Milliseconds in which anything on the page has to happen: SwiftShader is slow, and the page is tested beside what
 * compiles.
 */
const TIMEOUT = 180_000;

/** Whether the test runner runs this file, in which browsers are closed after all tests; else each is with its page. */
const isTested = process.env.NODE_TEST_CONTEXT !== undefined;

/** The browsers of this file's tests by their arguments: one that has shaders needs not compile them again. */
const browsers = new Map();
if (isTested) {
  after(() => Promise.all([...browsers.values()].map(async (browser) => (await browser).close())));
}

/** A browser that was started with these arguments. */
function launched(args) {
  if (!isTested) return chromium.launch({ ...launchOptions, args });
  const key = args.join(" ");
  if (!browsers.has(key)) browsers.set(key, chromium.launch({ ...launchOptions, args }));
  return browsers.get(key);
}

/** The main page with the least of work: one direction, and no colours. */
export const PLAIN = "#symmetric=&deviation=";

/** Opens the page for all tests of a file, which begin once its models are measured; returns what `open` gives by then. */
export function openedForAll(options) {
  const opened = {};
  before(async () => {
    Object.assign(opened, await open(options));
    await opened.page.locator('#result[data-state="done"]').waitFor();
  });
  after(() => opened.close());
  return opened;
}

/**
 * Opens the page, all that it folds unfolded, or as users see it with `unfolded: false`, and without motion. `webgpu: false` disables WebGPU, `webgl: false` all 3D APIs;
 * `touch: true` gives the device a touch screen; `path` selects another page than the main one, `outDir` another build, and `prepare` receives the
 * page before it is loaded.
 */
export async function open({
  webgpu = true,
  webgl = true,
  touch = false,
  unfolded = true,
  size = { width: 1280, height: 800 },
  path = PLAIN,
  outDir = "dist",
  prepare = async () => {},
} = {}) {
  const server = await preview({
    root: "www",
    build: { outDir },
    preview: { port: 0 },
    logLevel: "silent",
  });
  const args = launchOptions.args.filter((flag) => webgpu || !flag.includes("webgpu"));
  // A picture for people is smooth; every sample of a pixel costs the software as much as the first. Text and boxes
  // are drawn faster without the GPU than by one in software.
  args.push("--disable-gpu-rasterization");
  if (!process.env.PICTURE) args.push("--webgl-antialiasing-mode=none");
  if (!webgl) args.push("--disable-3d-apis");
  const browser = await launched(args);
  const page = await browser.newPage({ viewport: size, hasTouch: touch });
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.setDefaultTimeout(TIMEOUT);
  await page.emulateMedia({ reducedMotion: "reduce" });
  if (unfolded) await page.addInitScript(unfold);
  await prepare(page);
  await page.goto(new URL(path, server.resolvedUrls.local[0]).href);
  return {
    page,
    errors,
    data: () => page.locator("#result").evaluate(({ dataset }) => ({ ...dataset })),
    /** Waits until the panel of results reaches a state after `change`. */
    async until(state, change = async () => {}) {
      await page.locator("#result").evaluate(({ dataset }) => {
        dataset.state = "awaited";
      });
      await change();
      await page.locator(`#result[data-state="${state}"]`).waitFor();
    },
    /** Returns the terms and texts of a list in the panel of results. */
    async texts(list) {
      const terms = await page.locator(`${list} dt`).allTextContents();
      const texts = await page.locator(`${list} dd`).allTextContents();
      return Object.fromEntries(terms.map((term, index) => [term, texts[index]]));
    },
    async screenshot(name) {
      await drawn(page);
      saveScreenshot(name, await page.screenshot());
    },
    async close() {
      await (isTested ? page : browser).close();
      await server.close();
    },
  };
}

function unfold() {
  document.addEventListener("DOMContentLoaded", () => {
    for (const details of document.querySelectorAll("#panel details")) details.open = true;
  });
}
