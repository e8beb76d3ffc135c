// The package as it is packed: installed, bundled by every bundler, run in a
// browser and in Node, and judged by the tools that judge packages.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { publint } from "publint";
import { formatMessage } from "publint/utils";
import { inRoot } from "../../scripts/paths.mjs";
import { environment } from "../../scripts/process.mjs";
import { launchOptions } from "../../scripts/test/browser.mjs";
import {
  copyModules,
  esbuildBundle,
  importMap,
  rollupBundle,
  viteBundle,
  webpackBundle,
} from "./bundlers.mjs";
import { install, program } from "./install.mjs";
import { serve } from "./serve.mjs";

/** The programs that read files, as bundlers that find workers bundle them, and as others do. */
const files = ["direct-files", "cad-files", "worker-files"];
const filesInline = ["direct-files", "cad-files", "given-worker-files"];

/**
 * Every way to bundle: the programs that are run, other parts of them, and whether the
 * module is inlined, or copied by hand.
 */
const bundles = {
  vite: { bundle: viteBundle, names: ["direct", "own-worker", "worker", ...files] },
  webpack: { bundle: webpackBundle, names: ["direct", "own-worker", "worker", ...files] },
  rollup: {
    bundle: rollupBundle,
    names: ["direct", "given-worker", ...filesInline],
    parts: ["thread"],
    inline: true,
  },
  "rollup-copy": { bundle: rollupBundle, names: ["direct", "direct-files"], copy: true },
  esbuild: {
    bundle: esbuildBundle,
    names: ["direct", "given-worker", ...filesInline],
    parts: ["thread"],
    inline: true,
  },
  "esbuild-copy": { bundle: esbuildBundle, names: ["direct", "direct-files"], copy: true },
  "import-map": { bundle: importMap, names: ["direct", "worker", ...files] },
};

let packed;
let server;
let browser;
before(async () => {
  packed = await install();
  server = await serve(packed.folder);
  browser = await chromium.launch(launchOptions);
});
after(async () => {
  await browser?.close();
  server?.close();
  packed?.remove();
});

/** The two spheres' distance, which the programs measure, is 0.2. */
function isRight({ lower, upper, error }) {
  assert.equal(error, undefined);
  assert.ok(lower <= 0.2 + 1e-12 && 0.2 - 1e-12 <= upper && upper - lower < 1e-5);
}

/** What the page's program reports. */
async function outcome(path) {
  const page = await browser.newPage();
  try {
    await page.goto(`${server.address}/${path}`);
    return await page.evaluate(() => globalThis.outcome);
  } finally {
    await page.close();
  }
}

/** Bundles programs in the folder `place`, and runs those that are pages. */
async function bundleAndRun(place, { bundle, parts = [], inline, copy }, names) {
  const from = inline ? "nurbs-hausdorff/inline" : "nurbs-hausdorff";
  const source = program(packed.folder, place, from);
  const out = join(packed.folder, place, "out");
  await bundle({ source, out, names: [...names, ...parts], installed: packed.installed });
  if (copy) copyModules(packed.installed, out);
  for (const page of names) {
    await outcome(`${place}/out/${page}.html`).then(isRight, (error) =>
      assert.fail(`${page}: ${error}`),
    );
  }
}

for (const [name, how] of Object.entries(bundles)) {
  test(`${name}: ${how.names.join(" and ")} run in a browser`, () =>
    bundleAndRun(name, how, how.names));
}

test("with the optional peers installed, programs that read files are bundled and run as well", async () => {
  const peers = packed.installPeers();
  try {
    for (const [name, how] of Object.entries(bundles)) {
      const names = how.names.filter((name) => name.endsWith("files"));
      await bundleAndRun(`${name}-peers`, how, names);
    }
  } finally {
    peers.remove();
  }
});

test("esbuild without the module ends with a code and a remedy", async () => {
  const source = program(packed.folder, "missing", "nurbs-hausdorff");
  const out = join(packed.folder, "missing", "out");
  await esbuildBundle({ source, out, names: ["direct"] });
  const { error } = await outcome("missing/out/direct.html");
  assert.match(error, /^MODULE_FAILED: .*nurbs-hausdorff\/inline/);
});

/** Runs a module in Node, in the folder of the installed package. */
function inNode(text) {
  writeFileSync(join(packed.folder, "main.js"), text);
  const options = { cwd: packed.folder, encoding: "utf8" };
  const { status, stdout, stderr } = spawnSync(process.execPath, ["main.js"], options);
  assert.equal(status, 0, stderr);
  return JSON.parse(stdout);
}

for (const [from, name] of [
  ["nurbs-hausdorff", "direct"],
  ["nurbs-hausdorff/inline", "direct"],
  ["nurbs-hausdorff/worker", "worker"],
  ["nurbs-hausdorff", "direct-files"],
  ["nurbs-hausdorff/inline", "direct-files"],
  ["nurbs-hausdorff", "cad-files"],
  ["nurbs-hausdorff/worker", "worker-files"],
]) {
  test(`${from} runs in plain Node, and lets it end: ${name}`, () => {
    program(packed.folder, "node", from);
    const print = "console.log(JSON.stringify(await globalThis.outcome))";
    isRight(inNode(`import "./node/src/${name}.js"; ${print};`));
  });
}

test("the README's lines run in Node as they stand", () => {
  const readme = readFileSync(join(packed.installed, "README.md"), "utf8");
  writeFileSync(join(packed.folder, "readme.mjs"), readme.match(/```js\n([\s\S]*?)```/)[1]);
  cpSync(join(packed.installed, "examples"), join(packed.folder, "examples"), { recursive: true });
  const options = { cwd: packed.folder, encoding: "utf8" };
  const { stdout, stderr } = spawnSync(process.execPath, ["readme.mjs"], options);
  const [, lower, upper] = stdout.match(/^between (\S+) and (\S+), attained at /m) ?? [];
  // One bore of radius 9 is moved by 0.3: the far side of its wall is 0.3 from the other's.
  assert.ok(Number(lower) <= 0.3 && 0.3 <= Number(upper), stderr + stdout);
  assert.ok(Number(upper) - Number(lower) < 1e-4, stdout);
});

/** The compilers by which a consumer's types are checked: the newest, and the oldest that works. */
const COMPILERS = {
  tsc: ["tsc"],
  "TypeScript 5.7": [process.execPath, inRoot("node_modules", "typescript-oldest", "bin", "tsc")],
};

for (const [name, [compiler, ...before]] of Object.entries(COMPILERS)) {
  test(`a strict consumer's types are right by both resolutions with ${name}`, () => {
    const folder = join(packed.folder, "consumer");
    cpSync(inRoot("tests", "consumer", "main.ts"), join(folder, "main.ts"));
    for (const [module, moduleResolution] of [
      ["esnext", "bundler"],
      ["node16", "node16"],
    ]) {
      const compilerOptions = {
        target: "es2022",
        module,
        moduleResolution,
        strict: true,
        exactOptionalPropertyTypes: true,
        noEmit: true,
      };
      const config = join(folder, `tsconfig.${moduleResolution}.json`);
      writeFileSync(config, JSON.stringify({ compilerOptions, files: ["main.ts"] }));
      const { status, stdout } = spawnSync(compiler, [...before, "--project", config], {
        env: environment(),
        encoding: "utf8",
      });
      assert.equal(status, 0, stdout);
    }
  });
}

test("publint finds nothing", async () => {
  const { messages, pkg } = await publint({ pkgDir: packed.installed, strict: true });
  assert.deepEqual(
    messages.map((message) => formatMessage(message, pkg)),
    [],
  );
});

test("the types are found by every resolution of ES modules", () => {
  const { status, stdout } = spawnSync(
    "attw",
    // The wasm module is a file to fetch, without types; CommonJS imports the package by import().
    [
      packed.tarball,
      "--profile",
      "esm-only",
      "--exclude-entrypoints",
      "nurbs_hausdorff_bg.wasm",
      "nurbs_hausdorff_readers_bg.wasm",
      "nurbs_hausdorff_meshes_bg.wasm",
      "nurbs_hausdorff_scans_bg.wasm",
    ],
    { env: environment(), encoding: "utf8" },
  );
  assert.equal(status, 0, stdout);
});

test("the tarball holds the changelog, the picture and both licences", () => {
  const files = [
    "CHANGELOG.md",
    "README.md",
    "docs/images/page.png",
    "LICENSE-MIT",
    "LICENSE-APACHE",
  ];
  for (const file of files) assert.ok(existsSync(join(packed.installed, file)), file);
});
