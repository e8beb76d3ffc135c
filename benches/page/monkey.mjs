// Drives the page by random actions of a seed and says what went wrong:
//   node benches/page/monkey.mjs [seed] [minutes] [folder of the built page]
// The page is built before: npx vite build www. It exits with 1 after an error.
import { parseArgs } from "node:util";
import { open } from "../../tests/page/support/open.mjs";
import { act } from "./actions.mjs";
import { randomOf } from "./random.mjs";

/** Milliseconds within which the page comes to rest after the last action. */
const REST = 120_000;
/** Lines of the log that are printed with an error. */
const TOLD = 8;

const { positionals } = parseArgs({ allowPositionals: true });
const [seed = 1, minutes = 20] = positionals.slice(0, 2).map(Number);
const random = randomOf(seed);
const opened = await open({ path: "", outDir: positionals[2] });
const { page, errors } = opened;
const log = [];
page.on("crash", () => errors.push("the page crashed"));
page.on("console", (message) => {
  if (message.type() === "error") errors.push(`console: ${message.text()}`);
});

const end = Date.now() + minutes * 60_000;
let actions = 0;
let told = 0;
while (Date.now() < end) {
  log.push(await act(page, random));
  actions += 1;
  // An address that holds no number is that of a camera which is lost.
  if (page.url().includes("NaN")) errors.push(`not a number in ${page.url()}`);
  const alert = await page.locator("#error").textContent();
  if (alert?.includes("UNEXPECTED")) errors.push(alert);
  if (errors.length > told) {
    const added = errors.slice(told).join("\n  ");
    console.log(`after action ${actions}:\n  ${added}\n  ${log.slice(-TOLD).join("\n  ")}`);
    told = errors.length;
  }
}
// What the page showed before is no sign that it comes to rest.
await page.locator("#result").evaluate(({ dataset }) => {
  dataset.state = "awaited";
});
await page.selectOption("#preset", { index: 0 });
const ENDED = ':is([data-state="done"], [data-state="failed"], [data-state="cancelled"])';
const rests = await page
  .locator(`#result${ENDED}, body:has(#clearance${ENDED}) #result[data-state="paused"]`)
  .waitFor({ timeout: REST })
  .then(() => true)
  .catch(() => false);
if (!rests) {
  const state = await page.locator("#result").getAttribute("data-state");
  const loading = await page.locator("#loading").textContent();
  errors.push(`the page did not come to rest: ${state}, ${loading}`);
  console.log(`${errors.at(-1)}\n  ${log.slice(-TOLD).join("\n  ")}`);
}
await opened.close();
console.log(`seed ${seed}: ${actions} actions in ${minutes} min, ${errors.length} errors`);
process.exit(errors.length === 0 ? 0 : 1);
