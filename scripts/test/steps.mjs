// The steps of `npm test`, in order: each after those that it needs, and only if they passed. They run in
// rows, those of a row one after another and all rows at a time: what other steps need (without a `row`), `lints` of Rust,
// what is tested without a page, and the `page`. No row uses two cores all the time, and together they do. The lints wait
// for the command, as most steps do. A step with `tests` fails if it ran none. `run` is given the names of the chosen steps. A step with `quick` is one of `npm test -- --quick`,
// where `quick` replaces what it does; `release` replaces it in `npm test -- --release`, which tests what is
// published.
import { existsSync, readdirSync } from "node:fs";
import { buildApi } from "../build/api.mjs";
import { buildCommand, forTests } from "../build/command.mjs";
import { buildSite } from "../build/site.mjs";
import { areColorsBuilt, buildColors, colors } from "../build/wasm/colors.mjs";
import { chosen as chosenModules, modules, wasm32 } from "../build/wasm/modules.mjs";
import { areBuilt, buildQuick, useSmall } from "../build/wasm/quick.mjs";
import { buildSmall, small } from "../build/wasm/small.mjs";
import { inRoot } from "../paths.mjs";
import { environment, Failure, must, say, which } from "../process.mjs";
import { vulkan } from "../setup/lavapipe.mjs";
import { toolsEnvironment } from "../setup/tools.mjs";
import { checkBudget } from "./budget.mjs";
import { testEngines } from "./engines.mjs";
import { installPackages, testLibraries, testPython } from "./python.mjs";

const denyWarnings = ["--", "-D", "warnings"];

/** The crates of the wasm modules, with the exports of all of them. */
const wasm = [...wasm32, ...chosenModules(modules), `--package=${colors.crate}`];

/** All tests of Rust but those of its documentation. */
const rustTests = ["--lib", "--bins", "--tests"];

const cargo = (args, env = {}) => must("cargo", args, { env: environment(env) });

/** Lints have a folder of their own: Cargo does one thing at a time in a folder, and the tests would wait for them. */
const lint = (args, env = {}) =>
  cargo(args, { CARGO_TARGET_DIR: inRoot("target", "lints"), ...env });

function nodeTests(folder, env) {
  const files = existsSync(inRoot(folder))
    ? readdirSync(inRoot(folder), { recursive: true }).filter((name) => /\.test\.m?js$/.test(name))
    : [];
  if (files.length === 0) throw new Failure(`there is no *.test.mjs in ${folder}`);
  const paths = files.sort().map((name) => `${folder}/${name}`);
  return must("node", ["--test", "--test-reporter=spec", "--test-concurrency=1", ...paths], {
    env: environment(env),
  });
}

async function checkTypes() {
  say(`TypeScript API: ${await buildApi()}`);
  await must("tsc", ["--project", "www/tsconfig.json"]);
  await must("tsc", ["--project", "tests/consumer/tsconfig.json"]);
}

// Everything is built in the release profile, so that the tests and the package share what they are made of.
export const steps = [
  {
    name: "rustfmt",
    what: "Rust is formatted",
    quick: {},
    run: () => cargo(["fmt", "--check"]),
  },
  {
    name: "biome",
    what: "TypeScript and JavaScript format and lints",
    quick: {},
    run: () => must("biome", ["ci", "--error-on-warnings", "--colors=off"]),
  },
  {
    name: "python-packages",
    row: "tests",
    what: "packages that the tests of Python and of the engines import",
    run: installPackages,
  },
  {
    name: "dependencies",
    tests: true,
    what: "licences, versions and sources of the crates; npm's audit; what documents cite",
    quick: {},
    run: () => nodeTests("scripts/test", {}),
  },
  {
    name: "python",
    row: "tests",
    what: "the Python package's wheel, its types and tests",
    needs: ["python-packages"],
    run: () => testPython(),
    release: {
      what: "the Python package's wheel as it is published, its types and tests",
      run: () => testPython({}),
    },
  },
  {
    name: "wasm",
    what: "the wasm modules for the page and the tests; --release builds those that are published",
    run: async () => {
      say(`wasm modules: ${await buildQuick()}; the page's: ${await buildColors()}`);
    },
    release: {
      what: "the wasm modules that are published are within their budgets",
      // Optimising a whole module takes one core for minutes: 14 in all.
      run: async () => {
        say(`wasm modules, optimised: ${await buildSmall()}`);
        checkBudget();
        useSmall(small);
        say(`the page's module: ${await buildColors()}`);
      },
    },
  },
  {
    name: "types",
    row: "page",
    what: "TypeScript types: the API, the page, a consumer of the package",
    needs: ["wasm"],
    run: checkTypes,
    quick: {
      what: "TypeScript types, where the wasm modules are built",
      run: async () => {
        if (areBuilt() && areColorsBuilt()) return checkTypes();
        const line =
          "SKIPPED types: the wasm modules are not built of these sources, as npm start does";
        say(line);
        return line;
      },
    },
  },
  {
    name: "page-build",
    row: "page",
    what: "the page's production build",
    needs: ["wasm", "types"],
    run: () => must("vite", ["build", "www"]),
  },
  {
    name: "command",
    what: "the native command and the example that tests of other steps run",
    // Where the tests of Rust are chosen too they are compiled here: the crate with its own tests and without
    // them at a time, as each by itself leaves one core idle for half of the time.
    run: async (chosen) => {
      if (chosen.has("rust")) {
        await cargo(["test", ...forTests, "--no-run", ...rustTests]);
      } else {
        await buildCommand();
      }
      await cargo(["build", ...forTests, "--example", "experiments"]);
    },
  },
  {
    name: "page",
    row: "page",
    tests: true,
    what: "the page in headless Chromium",
    needs: ["command", "page-build"],
    run: () => nodeTests("tests/page", { CHROMIUM: which("chromium") }),
  },
  {
    name: "wasm-tests",
    row: "tests",
    tests: true,
    what: "wasm tests in headless Chromium with WebGPU",
    needs: ["wasm"],
    run: () =>
      // Compiled with the modules. The crate's own unit tests are native, and none of them runs in a browser.
      must("cargo", ["test", ...forTests, ...wasm, "--test", "wasm"], {
        env: toolsEnvironment({
          CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: "wasm-bindgen-test-runner",
          CHROMEDRIVER: which("chromedriver"),
          WASM_BINDGEN_TEST_ONLY_WEB: "1",
          WASM_BINDGEN_TEST_TIMEOUT: "240",
        }),
      }),
  },
  {
    name: "clippy",
    row: "lints",
    needs: ["command"],
    // The wheel's build refuses warnings of the crate as users build it.
    what: "Rust lints, native, with the feature `internals`",
    quick: {},
    run: () => lint(["clippy", "--release", "--locked", "--all-targets", ...denyWarnings]),
  },
  {
    name: "clippy-wasm",
    row: "lints",
    needs: ["command"],
    // Also the readers as a module has them, without archives and without the exports of the core.
    run: async () => {
      const clippy = ["clippy", "--release", "--locked"];
      await lint([...clippy, ...wasm, "--lib", "--test", "wasm", ...denyWarnings]);
      const readers = modules.filter(({ name }) => name === "nurbs_hausdorff_readers");
      await lint([...clippy, ...wasm32, ...chosenModules(readers), "--lib", ...denyWarnings]);
    },
  },
  {
    name: "doc",
    row: "lints",
    needs: ["command"],
    what: "Rust documentation",
    run: () => lint(["doc", "--release", "--locked", "--no-deps"], { RUSTDOCFLAGS: "-D warnings" }),
  },
  {
    name: "libraries",
    row: "lints",
    what: "the Python package with CadQuery, build123d, pyvista and meshio",
    needs: ["command", "python"],
    run: () => testLibraries(),
  },
  {
    name: "rust",
    row: "tests",
    tests: true,
    what: "Rust tests on lavapipe",
    needs: ["command"],
    // Clippy compiles the other examples and the benchmarks.
    run: async () => {
      const test = ["test", ...forTests, "--no-fail-fast"];
      const outputs = [await cargo([...test, ...rustTests], vulkan())];
      outputs.push(await cargo([...test, "--doc"], vulkan()));
      return outputs.join("\n");
    },
  },
  {
    name: "package",
    row: "page",
    tests: true,
    what: "the packed package in bundlers, a browser, Node and judges of packages",
    // The package has the command.
    needs: ["command", "wasm", "types"],
    run: () => nodeTests("tests/package", { CHROMIUM: which("chromium") }),
  },
  {
    name: "site",
    row: "page",
    what: "the pages of the JavaScript API, without a broken link or reference",
    needs: ["wasm", "types"],
    run: () => buildSite(inRoot("docs", "site", "js")),
  },
  {
    name: "node",
    row: "tests",
    tests: true,
    what: "the package in Node, on Dawn and lavapipe",
    needs: ["command", "wasm", "types"],
    run: () => nodeTests("tests/node", vulkan()),
  },
  {
    name: "engines",
    row: "tests",
    what: "many pairs on Ray and on Spark, with a worker killed",
    needs: ["command", "python"],
    run: testEngines,
  },
];
