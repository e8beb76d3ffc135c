// node benches/page/tasks.mjs: prints the longest task of the main thread of the built page
// (`npx vite build www`) in headless Chromium, in milliseconds of its own CPU, while the page is loaded and
// while two parts are opened and measured both ways. More than 50 ms are felt: the page answers late.
import { fileURLToPath } from "node:url";
import { open } from "../../tests/page/support/open.mjs";
import { mainThreadTasks, trace } from "./tracing.mjs";

/** Other programs share caches and cores with the page: the least of some attempts is printed. */
const ATTEMPTS = 3;
/** Milliseconds after the result in which the view is drawn. */
const DRAWING = 500;

const opened = await open();
const { page, until } = opened;

async function measure(what, work) {
  let least = Number.POSITIVE_INFINITY;
  for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
    const end = await trace(page);
    await work();
    await page.waitForTimeout(DRAWING);
    least = Math.min(least, mainThreadTasks(await end())[0]);
  }
  console.log(`${what}: ${least.toFixed(0)} ms`);
}

const done = () => page.locator('#result[data-state="done"]').waitFor();
const files = ["linkrods", "bearing"].map((name) =>
  fileURLToPath(new URL(`../../../shared/models/occt_${name}.json`, import.meta.url)),
);

try {
  await done();
  await measure("while the page is loaded", async () => {
    await page.reload();
    await done();
  });
  await measure("while two parts are opened and measured both ways", async () => {
    await until("done", () => page.setInputFiles("#file-a", files[0]));
    await until("done", () => page.setInputFiles("#file-b", files[1]));
    await until("done", () => page.locator("#symmetric").check());
    await page.locator("#symmetric").uncheck();
  });
} finally {
  await opened.close();
}
