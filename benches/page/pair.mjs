// node benches/page/pair.mjs A [B]: opens two CAD files at once on the built page (`npx vite build www`)
// in headless Chromium, B a copy of A if none is given, and prints the seconds until the first faces
// are drawn, both models, the interval and all colours; the CPU seconds of the page's process; and
// the longest task of the main thread, in milliseconds of its own CPU.
import { copyFile, mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import { open } from "../../tests/page/support/open.mjs";
import { watch } from "./marks.mjs";
import { mainThreadTasks, trace } from "./tracing.mjs";

/** Milliseconds after which the colours are given up. */
const TIMEOUT = 300_000;

const [a, b] = process.argv.slice(2);
if (!a) throw new Error("usage: pair.mjs A [B]");

const folder = await mkdtemp(join(tmpdir(), "pair-"));
const opened = await open({ path: "" });
try {
  const { page } = opened;
  await page.locator('#result[data-state="done"]').waitFor();
  const other = b ?? join(folder, `copy${extname(a)}`);
  if (b === undefined) await copyFile(a, other);
  const session = await page.context().browser().newBrowserCDPSession();
  const cpuSeconds = async () => {
    const { processInfo } = await session.send("SystemInfo.getProcessInfo");
    const pages = processInfo.filter(({ type }) => type === "renderer");
    return pages.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  };
  const end = await trace(page);
  const before = await cpuSeconds();
  await page.evaluate(watch, basename(other, extname(other)));
  await page.setInputFiles("#file-both", [a, other]);
  await page.waitForFunction(() => window.marks.colours, undefined, { timeout: TIMEOUT });
  for (const [what, time] of Object.entries(await page.evaluate(() => window.marks))) {
    console.log(`${what}: ${(time / 1000).toFixed(2)} s`);
  }
  console.log(`CPU of the page: ${((await cpuSeconds()) - before).toFixed(1)} s`);
  console.log(`longest task: ${Math.max(...mainThreadTasks(await end())).toFixed(0)} ms of CPU`);
} finally {
  await opened.close();
  await rm(folder, { recursive: true });
}
