// node benches/page/memory.mjs [A B]: opens two files 50 times on the built page (`npx vite build www`), in
// headless Chromium, and prints what the page's process holds after each ten: the JavaScript heap of the
// page after a collection, and the resident memory of all processes of the browser that draw it.
import { open } from "../../tests/page/support/open.mjs";
import { resident } from "./resident.mjs";

const LOADS = 50;
const EACH = 10;
const MIB = 2 ** 20;

const [a = "examples/parts/a.step", b = "examples/parts/b.step"] = process.argv.slice(2);

const opened = await open({ path: "" });
const { page } = opened;
try {
  await page.locator('#result[data-state="done"]').waitFor();
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  for (let load = 1; load <= LOADS; load++) {
    const files = load % 2 === 0 ? [a, b] : [b, a];
    await opened.until("done", () => page.setInputFiles("#file-both", files));
    if (load !== 1 && load % EACH !== 0) continue;
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    const heap = metrics.find(({ name }) => name === "JSHeapUsedSize").value / MIB;
    const nodes = metrics.find(({ name }) => name === "Nodes").value;
    console.log(
      `after ${load}: heap ${heap.toFixed(1)} MiB, ${nodes} nodes, resident ${resident().toFixed(0)} MiB`,
    );
  }
} finally {
  await opened.close();
}
