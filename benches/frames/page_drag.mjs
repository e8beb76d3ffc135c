// node benches/frames/page_drag.mjs [A B]: answers a second in the built page (`npx vite build www`) in
// headless Chromium while a part is dragged: the clearance of A from B, whether they overlap, and the pairs
// of faces that come near, shown in the panel. NIST 5 in NIST 1 of ../shared/models unless files are given.
// A's sliders move it through B. Prints answers a second by the clock and the meetings that were shown, and
// CPU seconds an answer of the page's process.
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { gunzipSync } from "node:zlib";
import { open, PLAIN } from "../../tests/page/support/open.mjs";

/** Milliseconds between two moves, about one frame of a display, and of the whole drag. */
const FRAME = 16;
const DURATION = 15_000;

const shared = new URL("../../../shared/models/step/", import.meta.url);
const given = process.argv.slice(2);
const names = given.length === 2 ? given : ["NIST_MBE_PMI_5.stp.gz", "NIST_MBE_PMI_1.stp.gz"];

function file(name) {
  const bytes = readFileSync(given.length === 2 ? name : new URL(name, shared));
  const buffer = name.endsWith(".gz") ? gunzipSync(bytes) : bytes;
  return { name: basename(name, ".gz"), mimeType: "application/step", buffer };
}

async function cpuSeconds(session) {
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const found = processInfo.filter(({ type }) => type === "renderer");
  return found.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

const opened = await open({ path: PLAIN, webgpu: false, size: { width: 800, height: 480 } });
try {
  const { page } = opened;
  page.setDefaultTimeout(300_000);
  await page.locator('#result[data-state="done"]').waitFor();
  for (const [index, name] of names.entries()) {
    await opened.until("done", () => page.setInputFiles(`#file-${"ab"[index]}`, file(name)));
  }
  await page.locator("#clearance-start").click();
  await page.locator('#clearance[data-state="done"]').waitFor();
  const session = await page.context().browser().newBrowserCDPSession();
  const before = await cpuSeconds(session);
  const drag = async ({ frame, duration }) => {
    const sliders = ["x", "y", "z"].map((axis) => document.querySelector(`#move-${axis}`));
    const section = document.querySelector("#clearance");
    const meetings = {};
    let answers = 0;
    let worst = 0;
    let last = performance.now();
    const observer = new MutationObserver(() => {
      if (section.dataset.state !== "done") return;
      answers += 1;
      worst = Math.max(worst, performance.now() - last);
      last = performance.now();
      const { meeting } = section.dataset;
      meetings[meeting] = (meetings[meeting] ?? 0) + 1;
    });
    observer.observe(section, { attributes: true, attributeFilter: ["data-state"] });
    const start = performance.now();
    let moves = 0;
    while (performance.now() - start < duration) {
      const turn = (performance.now() - start) / 1000;
      sliders.forEach((slider, axis) => {
        slider.value = 0.6 * Math.sin((axis + 1) * turn + axis);
      });
      sliders[0].dispatchEvent(new Event("input", { bubbles: true }));
      moves += 1;
      await new Promise((resolve) => setTimeout(resolve, frame));
    }
    observer.disconnect();
    return { answers, moves, worst, meetings, seconds: (performance.now() - start) / 1000 };
  };
  const found = await page.evaluate(drag, { frame: FRAME, duration: DURATION });
  const used = (await cpuSeconds(session)) - before;
  const { answers, moves, worst, meetings, seconds } = found;
  console.log(
    `${(answers / seconds).toFixed(1)} answers a second of ${(moves / seconds).toFixed(1)} moves,`,
    `at most ${worst.toFixed(0)} ms between two, ${JSON.stringify(meetings)},`,
    `${((1000 * used) / answers).toFixed(1)} ms of CPU an answer`,
  );
} finally {
  await opened.close();
}
