// The pictures of the report for browsers, by both command lines.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { buildCommand, command as native } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { interchangeSquare } from "../support.mjs";
import { missing, sharedFile } from "./files.mjs";
import { picturesOf } from "./png.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const COMMANDS = [[process.execPath, join(root, "dist/cli/main.js")], [native]];
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

const write = (name, content) => writeFileSync(join(folder, name), content);

/** The pages that both command lines write. */
function pages(...args) {
  return COMMANDS.map(([program, ...rest]) => {
    const options = { cwd: folder, encoding: "utf8", env: environment(), maxBuffer: 2 ** 28 };
    const outcome = spawnSync(program, [...rest, ...args, "--format", "html"], options);
    assert.ok(outcome.status === 0 || outcome.status === 1, outcome.stderr);
    return outcome.stdout;
  });
}

/** Asserts that both pages have the same pictures, legends and captions, and returns those of Node. */
function assertSame([ours, theirs]) {
  const [one, other] = [ours, theirs].map(picturesOf);
  assert.deepEqual(
    one.map(({ alt }) => alt),
    other.map(({ alt }) => alt),
  );
  for (const [index, { alt, width, height, pixels }] of one.entries()) {
    const also = other[index];
    assert.deepEqual([width, height], [also.width, also.height]);
    // Rounding decides a few samples at edges, and steps of colours by one.
    const off = pixels.filter((value, at) => Math.abs(value - also.pixels[at]) > 3).length;
    assert.ok(off < pixels.length / 500, `${alt}: ${off} of ${pixels.length}`);
  }
  const texts = (html) => html.match(/<figcaption>.*?<\/figcaption>/gs);
  assert.deepEqual(texts(ours), texts(theirs));
  const legends = (html) => html.match(/<svg class="legend".*?<\/svg>/gs);
  assert.deepEqual(legends(ours), legends(theirs));
  assert.equal(legends(ours).length, ours.match(/<figure class="views">/g).length);
  return one;
}

/** The parts of a picture's pixels that a test of red, green and blue accepts. */
function part({ pixels }, accepts) {
  let count = 0;
  for (let at = 0; at < pixels.length; at += 3) {
    if (accepts(pixels[at], pixels[at + 1], pixels[at + 2])) count += 1;
  }
  return (3 * count) / pixels.length;
}

test("both show a square and one above it: each in the colour of its side", () => {
  write("low.json", JSON.stringify(interchangeSquare(0)));
  write("high.json", JSON.stringify(interchangeSquare(3)));
  const html = pages("distance", "low.json", "high.json", "--symmetric");
  const shown = assertSame(html);
  assert.deepEqual(
    shown.map(({ alt }) => alt),
    [
      "Signed deviation of A from B, seen from the front, the right and above",
      "Signed deviation of A from B, seen from the back, the left and below",
      "Signed deviation of A from B, the worst place seen from near",
      "Signed deviation of B from A, seen from the front, the right and above",
      "Signed deviation of B from A, seen from the back, the left and below",
    ],
  );
  // A is behind the normals of B, and B before those of A: the ends of the scale, #2166ac and #b2182b,
  // darker by the same factor.
  const like =
    ([r, g, b], slack) =>
    (red, green, blue) =>
      Math.abs(red * g - green * r) < slack &&
      Math.abs(blue * g - green * b) < slack &&
      red + blue < 500 &&
      red + blue > 60;
  assert.ok(part(shown[0], like([0x21, 0x66, 0xac], 400)) > 0.2);
  assert.ok(part(shown[3], like([0xb2, 0x18, 0x2b], 400)) > 0.2);
  assert.equal(part(shown[0], like([0xb2, 0x18, 0x2b], 400)), 0);
});

test("both show a part against a moved copy alike", { skip: missing }, () => {
  write("part.stp", sharedFile("step/NIST_MBE_PMI_11.stp"));
  const moved = ["--translate", "0.1,0.05,0.2", "--rotate", "0,0,1,0.2"];
  const shown = assertSame(pages("diff", "part.stp", "part.stp", ...moved, "--limit", "0.15"));
  assert.equal(shown.length, 5);
  // The part is in the pictures, and what is allowed in green.
  for (const picture of [shown[0], shown[1]]) {
    assert.ok(part(picture, (...color) => color.every((value) => value === 255)) < 0.8);
    assert.ok(part(picture, (red, green, blue) => green > red + 9 && green > blue + 9) > 0.002);
  }
});

test("both show a mesh against surfaces, and points, alike", () => {
  const corners = ["0 0 0", "1 0 0", "1 1 0.5", "0 1 0"].map((at) => `vertex ${at}`);
  const facet = (a, b, c) =>
    `facet normal 0 0 1\nouter loop\n${corners[a]}\n${corners[b]}\n${corners[c]}\nendloop\nendfacet`;
  write("mesh.stl", `solid s\n${facet(0, 1, 2)}\n${facet(0, 2, 3)}\nendsolid s\n`);
  write("square.json", JSON.stringify(interchangeSquare(0)));
  assertSame(pages("distance", "mesh.stl", "square.json", "--symmetric"));
  const points = Array.from(
    { length: 400 },
    (_, at) => `${(at % 20) / 19} ${Math.floor(at / 20) / 19} 0.1`,
  );
  write("points.xyz", points.join("\n"));
  const [front] = assertSame(pages("distance", "points.xyz", "square.json"));
  // 400 squares of three pixels, each of which touches three or four pixels along both axes.
  const drawn = part(front, (...color) => color.some((value) => value < 250));
  const pixels = drawn * front.width * front.height;
  assert.ok(pixels > 400 * 9 && pixels < 400 * 16, `${pixels}`);
});

test("the legend's colours are those of the page", async () => {
  const bundled = await build({
    stdin: {
      contents: 'export { ColorScale } from "./www/src/scene/colors/scale.ts";',
      resolveDir: root,
    },
    ...{ bundle: true, write: false, format: "esm", logLevel: "error" },
  });
  write("scale.mjs", bundled.outputFiles[0].contents);
  const { ColorScale } = await import(join(folder, "scale.mjs"));
  const [html] = pages("distance", "low.json", "high.json", "--symmetric", "--limit", "1");
  const extent = { lowest: -3, highest: 3, largest: 3, floor: 1e-6 };
  const options = { map: "diverging", absolute: false, range: undefined, steps: 0 };
  const scale = new ColorScale(extent, { ...options, allowed: { above: 1, below: 1 } });
  const [legend] = html.match(/<svg class="legend".*?<\/svg>/s);
  const colors = [...legend.matchAll(/fill="(#[0-9a-f]{6})"/g)].map(([, color]) => color);
  assert.deepEqual(
    colors,
    scale.stops(48).map((color) => `#${color.getHexString()}`),
  );
  const ticks = [...legend.matchAll(/<text [^>]*>(.*?)</g)].map(([, text]) => text);
  assert.deepEqual(ticks.slice(0, 4), [
    "+3.00000",
    "−3.00000",
    "allowed +1.00000",
    "allowed −1.00000",
  ]);
});

test("of many pairs that differ the first twenty have pictures", () => {
  for (const [side, height] of [
    ["old", 0],
    ["new", 3],
  ]) {
    mkdirSync(join(folder, side));
    for (let index = 0; index < 22; index++) {
      write(`${side}/${index + 10}.json`, JSON.stringify(interchangeSquare(height)));
    }
    write(`${side}/same.json`, JSON.stringify(interchangeSquare(0)));
  }
  for (const html of pages("distance", "old", "new", "--limit", "1")) {
    const sections = html.split("<section ").slice(1);
    assert.deepEqual(
      sections.map((section) => section.includes("<img ")),
      Array.from({ length: 22 }, (_, index) => index < 20),
    );
    assert.equal(html.split("there are no more in one report").length, 3);
  }
});
