// The set-up of a fresh machine: what it will install, then one line per step.
import { existsSync } from "node:fs";
import { Failure } from "../process.mjs";
import { home as pythonHome, packages as pythonPackages } from "../test/python.mjs";
import { browser, compiler, debian, firefox, java, missingPackages } from "./debian.mjs";
import { driver, lavapipe } from "./lavapipe.mjs";
import { packages, siteGenerator } from "./packages.mjs";
import { missingParts, rust } from "./rust.mjs";
import { missingTools, tools } from "./tools.mjs";

/** Installs programs without which only the tests that need them are skipped. */
async function optional(needs) {
  try {
    return await debian(needs);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    return `its tests are skipped: ${error.message}`;
  }
}

const systemPackages = (needs) => ({
  name: "system packages",
  missing: () => missingPackages(needs),
  install: () => debian(needs),
});

const rustParts = (name, ...parts) => ({
  name,
  missing: () => missingParts(...parts),
  install: () => rust(...parts),
});

const npmPackages = {
  name: "npm packages",
  missing: () => (packages.present() ? [] : ["those of package-lock.json in node_modules"]),
  install: packages.install,
};

const wasmTools = (...names) => ({
  name: "wasm tools",
  missing: () => missingTools(names).map((name) => `${name}, built from tools/`),
  install: () => tools(names),
});

/** What building and serving the page need. */
const forPage = [
  systemPackages(compiler),
  rustParts("Rust target", "target"),
  npmPackages,
  wasmTools("bindgen"),
];

/** What the tests need. */
const forTests = [
  systemPackages([...compiler, ...browser]),
  { name: "Firefox", missing: () => missingPackages(firefox), install: () => optional(firefox) },
  { name: "Java", missing: () => missingPackages(java), install: () => optional(java) },
  {
    name: "lavapipe",
    missing: () => (driver() ? [] : ["Mesa's Vulkan driver, where the system's is too old"]),
    install: lavapipe,
  },
  rustParts("Rust target and components", "target", "components"),
  npmPackages,
  {
    name: "generator of the API's pages",
    missing: () =>
      siteGenerator.present() ? [] : ["the packages of tools/site/package-lock.json"],
    install: siteGenerator.install,
  },
  wasmTools("bindgen", "wasm-bindgen-test-runner"),
];

/** What single tests install when they begin, and are skipped without. */
const byTests = [
  {
    name: "Python packages",
    missing: () => (existsSync(pythonHome) ? [] : pythonPackages),
  },
];

/** Says what will be installed, before anything is. */
function announce(steps) {
  const lines = steps
    .map(({ name, missing }) => [name, missing()])
    .filter(([, missing]) => missing.length > 0)
    .map(([name, missing]) => `  ${name}: ${missing.join(", ")}`);
  if (lines.length === 0) return;
  console.log(`set-up will install what is missing:\n${lines.join("\n")}`);
}

async function setUp(steps, later = []) {
  announce([...steps, ...later]);
  for (const { name, install } of steps) {
    const start = performance.now();
    try {
      const result = await install();
      const seconds = ((performance.now() - start) / 1000).toFixed(1);
      console.log(`set-up: ${name}: ${result} (${seconds} s)`);
    } catch (error) {
      error.message = `set-up: ${name}: ${error.message}`;
      throw error;
    }
  }
}

/** Sets up everything that building and serving the page need. */
export const setUpForPage = () => setUp(forPage);

/** Sets up everything that the tests need. */
export const setUpForTests = () => setUp(forTests, byTests);
