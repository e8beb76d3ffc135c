// node benches/frames/drop.mjs FILE: opens a CAD file as model A of the built page (`npx vite build
// www`) in headless Chromium, and prints the time until it is drawn, the CPU seconds of the page's
// process meanwhile, and the bytes of what is fetched for it: of each body, compressed by gzip at
// its highest level as a server would send it. The page's own files, fetched before, do not count.
import { basename } from "node:path";
import { gzipSync } from "node:zlib";
import { open, PLAIN } from "../../tests/page/support/open.mjs";

const file = process.argv[2];
if (!file) throw new Error("usage: drop.mjs FILE");

/** CPU seconds of the processes of a kind, by Chromium's own account. */
async function cpuSeconds(session, kind) {
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const found = processInfo.filter(({ type }) => type === kind);
  return found.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

const opened = await open({ path: PLAIN });
try {
  const { page } = opened;
  await page.locator('#result[data-state="done"]').waitFor();
  const fetched = [];
  page.on("response", (response) => fetched.push(response));
  const session = await page.context().browser().newBrowserCDPSession();
  const before = await cpuSeconds(session, "renderer");
  await page.evaluate((name) => {
    window.drawn = new Promise((resolve) => {
      const check = () => {
        const chosen = document.querySelector("#shape-a option:checked")?.textContent;
        // The models are shown with the option; a frame later they are drawn.
        if (chosen?.includes(name)) requestAnimationFrame(() => setTimeout(() => resolve(performance.now())));
        else requestAnimationFrame(check);
      };
      document.querySelector("#file-a").addEventListener("change", () => {
        window.dropped = performance.now();
        check();
      }, { capture: true });
    });
  }, basename(file));
  await page.setInputFiles("#file-a", file);
  const seconds = await page.evaluate(async () => ((await window.drawn) - window.dropped) / 1000);
  const used = (await cpuSeconds(session, "renderer")) - before;
  let bytes = 0;
  for (const response of fetched.filter((response) => response.url().startsWith("http"))) {
    const size = gzipSync(await response.body(), { level: 9 }).length;
    bytes += size;
    console.log(`fetched ${basename(response.url())}: ${size} bytes by gzip`);
  }
  console.log(`drawn after ${seconds.toFixed(2)} s, ${used.toFixed(2)} CPU seconds, ${bytes} bytes fetched`);
} finally {
  await opened.close();
}
