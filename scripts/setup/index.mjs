// The set-up of a fresh machine, one line per step.
import { Failure } from "../process.mjs";
import { browser, compiler, debian, firefox, java } from "./debian.mjs";
import { lavapipe } from "./lavapipe.mjs";
import { packages, siteGenerator } from "./packages.mjs";
import { rust } from "./rust.mjs";
import { tools } from "./tools.mjs";

async function step(name, action) {
  const start = performance.now();
  try {
    const result = await action();
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    console.log(`set-up: ${name}: ${result} (${seconds} s)`);
  } catch (error) {
    error.message = `set-up: ${name}: ${error.message}`;
    throw error;
  }
}

/** Installs programs without which only the tests that need them are skipped. */
async function optional(needs) {
  try {
    return await debian(needs);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    return `its tests are skipped: ${error.message}`;
  }
}

/** Sets up everything that building and serving the page need. */
export async function setUpForPage() {
  await step("system packages", () => debian(compiler));
  await step("Rust target", () => rust("target"));
  await step("npm packages", packages);
  await step("wasm tools", tools);
}

/** Sets up everything that the tests need. */
export async function setUpForTests() {
  await step("system packages", () => debian([...compiler, ...browser]));
  await step("Firefox", () => optional(firefox));
  await step("Java", () => optional(java));
  await step("lavapipe", lavapipe);
  await step("Rust target and components", () => rust("target", "components"));
  await step("npm packages", packages);
  await step("generator of the API's pages", siteGenerator);
  await step("wasm tools", tools);
}
