// The colours of the command's report are those of the page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { buildCommand, command } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { interchangeSquare } from "../support.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

const write = (name, content) => writeFileSync(join(folder, name), content);

test("the legend's colours are those of the page", async () => {
  write("low.json", JSON.stringify(interchangeSquare(0)));
  write("high.json", JSON.stringify(interchangeSquare(3)));
  const bundled = await build({
    stdin: {
      contents: 'export { ColorScale } from "./www/src/scene/colors/scale.ts";',
      resolveDir: root,
    },
    ...{ bundle: true, write: false, format: "esm", logLevel: "error" },
  });
  write("scale.mjs", bundled.outputFiles[0].contents);
  const { ColorScale } = await import(join(folder, "scale.mjs"));
  const args = ["distance", "low.json", "high.json", "--symmetric", "--limit", "1"];
  const options = { cwd: folder, encoding: "utf8", env: environment(), maxBuffer: 2 ** 28 };
  const { stdout: html, stderr } = spawnSync(command, [...args, "--format", "html"], options);
  const extent = { lowest: -3, highest: 3, largest: 3, floor: 1e-6 };
  const settings = { map: "diverging", absolute: false, range: undefined, steps: 0 };
  const scale = new ColorScale(extent, { ...settings, allowed: { above: 1, below: 1 } });
  const [legend] = html.match(/<svg class="legend".*?<\/svg>/s) ?? assert.fail(stderr);
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
