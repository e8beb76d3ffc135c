// The actions of a random user.
import { modelFile, planes, row, sphereParts } from "../../tests/page/support/models.mjs";

/** A wave of points, of 20 along a side. */
const SCAN = Array.from({ length: 400 }, (_, index) => {
  const [x, y] = [Math.floor(index / 20), index % 20];
  return `${x / 10} ${y / 10} ${Math.sin(x / 5) / 2}`;
});

const FILES = [
  modelFile("plane.json", planes(0)),
  modelFile("planes.json", planes(0.5, 2)),
  modelFile("row.json", row(0, 0.1, 0.3)),
  modelFile("part.json", sphereParts.a),
  modelFile("concentric.json", sphereParts.b),
  { name: "scan.xyz", mimeType: "text/plain", buffer: Buffer.from(SCAN.join("\n")) },
  {
    ...{ name: "mesh.obj", mimeType: "text/plain" },
    buffer: Buffer.from("v 0 0 0\nv 2 0 0\nv 0 2 0.5\nv 2 2 0\nf 1 2 3\nf 2 4 3\n"),
  },
  { name: "bad.step", mimeType: "text/plain", buffer: Buffer.from("ISO-10303-21;\n#1=") },
  { name: "empty.json", mimeType: "text/plain", buffer: Buffer.from("") },
];
const SIZES = [
  { width: 1280, height: 800 },
  { width: 820, height: 1180 },
  { width: 390, height: 844 },
  { width: 844, height: 390 },
];
/** Values that users type, and those that they should not. */
const VALUES = ["0", "1", "-1", "0.1", "0.37", "2", "90", "1e-9", "1e6", "1e300", "", "-0"];
const KEYS = ["n", "Escape", "Tab", "Enter", "ArrowUp", "ArrowDown", "Control+z", "Control+y"];
/** Buttons that open a dialog of the system or save a file each time. */
const AVOIDED = '[type="file"], #dismiss';

/** How often an action is taken, beside the others. */
const ACTIONS = [
  [8, change],
  [5, click],
  [5, drag],
  [3, wheel],
  [3, hover],
  [2, key],
  [2, openFile],
  [1, resize],
  [1, loseContext],
  [1, standardView],
];
const CHOICES = ACTIONS.flatMap(([count, action]) => Array(count).fill(action));

/** Takes one action and returns what it was. */
export async function act(page, random) {
  const action = random.of(CHOICES);
  const what = await action(page, random).catch((error) => `not done: ${error.message.split("\n")[0]}`);
  // A pause of any length: most actions come while the ones before still work.
  await page.waitForTimeout(random.below(4) === 0 ? random.below(1500) : random.below(80));
  return `${action.name} ${what ?? ""}`;
}

/** Gives a control another value, visible or folded away. */
async function change(page, random) {
  const value = random.of(VALUES);
  const [place, part] = [random.next(), random.next()];
  return page.evaluate(
    ({ value, place, part, avoided }) => {
      const all = [...document.querySelectorAll("input, select")].filter(
        (node) => !node.matches(avoided) && !node.disabled,
      );
      const node = all[Math.floor(place * all.length)];
      if (node.type === "checkbox") node.checked = !node.checked;
      else if (node.type === "range") node.value = `${+node.min + part * (node.max - node.min)}`;
      else if (node instanceof HTMLSelectElement) {
        node.selectedIndex = Math.floor(part * node.options.length);
      } else node.value = node.type === "text" || node.type === "search" ? "e" : value;
      for (const type of ["input", "change"]) node.dispatchEvent(new Event(type, { bubbles: true }));
      return `${node.id || node.getAttribute("aria-label")} = ${node.value}`;
    },
    { value, place, part, avoided: AVOIDED },
  );
}

async function click(page, random) {
  return page.evaluate(
    ({ place }) => {
      const all = [...document.querySelectorAll("button, summary, #histogram .target, #axes [tabindex]")];
      const node = all[Math.floor(place * all.length)];
      node.dispatchEvent(new MouseEvent("click", { bubbles: true, cancelable: true }));
      return node.id || node.textContent?.trim().slice(0, 40);
    },
    { place: random.next() },
  );
}

/** A point of the view, in pixels of the window. */
async function pointOfView(page, random) {
  const box = await page.locator("#canvas").boundingBox();
  return [box.x + random.next() * box.width, box.y + random.next() * box.height];
}

async function drag(page, random) {
  const [from, to] = [await pointOfView(page, random), await pointOfView(page, random)];
  const button = random.of(["left", "left", "right", "middle"]);
  await page.mouse.move(...from);
  await page.mouse.down({ button });
  await page.mouse.move(...to, { steps: 1 + random.below(6) });
  await page.mouse.up({ button });
  return `${button} ${from.map(Math.round)} to ${to.map(Math.round)}`;
}

async function wheel(page, random) {
  await page.mouse.move(...(await pointOfView(page, random)));
  const turn = random.of([-3000, -300, -100, 100, 300, 3000, 100_000]);
  await page.mouse.wheel(0, turn);
  return `${turn}`;
}

async function hover(page, random) {
  const place = await pointOfView(page, random);
  await page.mouse.move(...place);
  if (random.below(2) === 0) await page.mouse.click(...place);
}

async function key(page, random) {
  const pressed = random.of(KEYS);
  await page.keyboard.press(pressed);
  return pressed;
}

async function openFile(page, random) {
  const [file, input] = [random.of(FILES), random.of(["#file-a", "#file-b"])];
  await page.setInputFiles(input, file);
  return `${file.name} ${input}`;
}

async function resize(page, random) {
  const size = random.of(SIZES);
  await page.setViewportSize(size);
  return JSON.stringify(size);
}

/** The canvas loses its context, and has it again a moment later. */
async function loseContext(page, random) {
  return page.evaluate(
    (pause) => {
      const canvas = document.getElementById("canvas");
      const loss = canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context");
      loss?.loseContext();
      setTimeout(() => loss?.restoreContext(), pause);
    },
    random.below(500),
  );
}

async function standardView(page, random) {
  const options = await page.locator("#direction option").count();
  await page.selectOption("#direction", { index: random.below(options) });
}
