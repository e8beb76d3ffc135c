// The colours of the command's report are those of the page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { buildCommand, command } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { create, interchangeSquare, near } from "../support.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

const write = (name, content) => writeFileSync(join(folder, name), content);

/** The colours of a scale of the page, from low to high. */
async function pageColors(extent, allowed, absolute = false) {
  const bundled = await build({
    stdin: {
      contents: 'export { ColorScale } from "./www/src/scene/colors/scale.ts";',
      resolveDir: root,
    },
    ...{ bundle: true, write: false, format: "esm", logLevel: "error" },
  });
  write("scale.mjs", bundled.outputFiles[0].contents);
  const { ColorScale } = await import(join(folder, "scale.mjs"));
  const settings = { map: "diverging", absolute, range: undefined, steps: 0 };
  const scale = new ColorScale(extent, { ...settings, allowed });
  return scale.stops(48).map((color) => `#${color.getHexString()}`);
}

/** The colours and the ticks of the legend of a report on two files. */
function legendOf(...args) {
  const options = { cwd: folder, encoding: "utf8", env: environment(), maxBuffer: 2 ** 28 };
  const { stdout: html, stderr } = spawnSync(
    command,
    ["distance", ...args, "--symmetric", "--format", "html"],
    options,
  );
  const [legend] = html.match(/<svg class="legend".*?<\/svg>/s) ?? assert.fail(stderr);
  return {
    colors: [...legend.matchAll(/fill="(#[0-9a-f]{6})"/g)].map(([, color]) => color),
    ticks: [...legend.matchAll(/<text [^>]*>(.*?)</g)].map(([, text]) => text),
  };
}

test("the legend's colours are those of the page", async () => {
  write("low.json", JSON.stringify(interchangeSquare(0)));
  write("high.json", JSON.stringify(interchangeSquare(3)));
  const { colors, ticks } = legendOf("low.json", "high.json", "--limit", "1");
  const extent = { lowest: -3, highest: 3, largest: 3, floor: 1e-6 };
  assert.deepEqual(colors, await pageColors(extent, { above: 1, below: 1 }));
  assert.deepEqual(ticks.slice(0, 4), [
    "+3.00000",
    "−3.00000",
    "allowed +1.00000",
    "allowed −1.00000",
  ]);
  // What agrees to less than the models' rounding is allowed, in the colour of that.
  const same = legendOf("low.json", "low.json", "--limit", "1");
  const none = { lowest: 0, highest: 0, largest: 0, floor: 5e-7 * Math.SQRT2 };
  assert.deepEqual(same.colors, await pageColors(none, { above: 1, below: 1 }));
});

test("without signs the legend's colours are those of the page's distances", async () => {
  // Points have no normals.
  write("low.xyz", "0 0 0\n1 0 0\n");
  write("high.xyz", "0 0 2\n1 0 2\n");
  const { colors, ticks } = legendOf("low.xyz", "high.xyz", "--limit", "1");
  const extent = { lowest: 0, highest: 0, largest: 2, floor: 1e-6 };
  assert.deepEqual(colors, await pageColors(extent, { above: 1, below: 1 }, true));
  assert.deepEqual(ticks, ["2.00000", "0.00000", "allowed 1.00000"]);
});

test("the legend's ends are the extremes of the maps that the page draws", async () => {
  const paths = ["a.step", "b.step"].map((name) => join(root, "examples", "parts", name));
  const { ticks } = legendOf(...paths, "--limit", "0.1");
  const hd = await create();
  const read = async (path) => hd.readCad(readFileSync(path), { name: "part.step" });
  const [a, b] = [await read(paths[0]), await read(paths[1])];
  const { forward, reverse } = await hd.distance(a, b, { symmetric: true });
  const known = ({ upper, witness }, own, foot) => ({
    uppers: [upper],
    farthest: { face: witness[own].face, point: witness[own].point, foot: witness[foot].point },
  });
  const maps = await hd.deviationMaps(a, b, {
    a: known(forward, "a", "b"),
    b: known(reverse, "b", "a"),
  });
  const signed = [...maps.a.signed, ...maps.b.signed];
  // One bore is 0.3 farther right: on one side of it there is more of A, on the other of B.
  near(Math.max(...signed), 0.3, 1e-6);
  near(Math.min(...signed), -0.3, 1e-6);
  // Five digits below the models' order of magnitude.
  const digits = 5 - Math.floor(Math.log10(maps.diagonal));
  assert.deepEqual(
    ticks.slice(0, 2),
    ["+", "−"].map((sign) => `${sign}${(0.3).toFixed(digits)}`),
  );
  for (const owner of [a, b, hd]) owner.dispose();
});
