// The Python package: its wheel, installed in an environment of its own, and its tests.
import { existsSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { cache, inRoot } from "../paths.mjs";
import { ask, environment, Failure, must, say } from "../process.mjs";

/** The environment that all checkouts share: the builder, and what the tests import. */
export const home = join(cache, "python-1");
export const program = (name) => join(home, "bin", name);

/** What the tests of the package import, and what those of the engines need in addition. */
const groups = {
  python: {
    packages: ["maturin>=1.9,<2", "numpy", "pytest", "mypy", "trimesh", "matplotlib", "tqdm"],
    imports: "maturin, numpy, pytest, mypy, trimesh, matplotlib, tqdm",
  },
  engines: {
    packages: ["ray[data]>=2.50,<3", "pyspark>=4,<5", "pandas>=2,<3", "pyarrow"],
    imports: "ray.data, pyspark, pandas, pyarrow",
  },
};

export const packages = Object.values(groups).flatMap((group) => group.packages);

/** Libraries whose shapes and meshes the package takes, in environments of their own: their versions of OCP differ. */
const libraries = [
  {
    name: "cadquery",
    packages: ["cadquery", "pyvista", "meshio"],
    tests: ["test_cadquery.py", "test_pyvista.py", "test_meshio.py"],
  },
  { name: "build123d", packages: ["build123d"], tests: ["test_build123d.py"] },
];

/** Why a group cannot be had, by its name. */
const why = {};

/** Installs a group of packages in an environment, or returns why that cannot be done. */
async function install({ packages, imports }, folder = home) {
  const of = (name) => join(folder, "bin", name);
  if (ask(of("python"), ["-c", `import ${imports}`]) !== undefined) return undefined;
  try {
    if (!existsSync(of("pip"))) {
      rmSync(folder, { recursive: true, force: true });
      await must("python3", ["-m", "venv", folder]);
    }
    await must(of("pip"), ["install", "--quiet", ...packages]);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    return `its packages cannot be installed: ${error.message.split("\n")[0]}`;
  }
  return undefined;
}

/** Installs what both steps need, mostly downloads, while other steps compile. */
export async function installPackages() {
  const version = ask("python3", ["-c", "import sys; print(sys.version_info >= (3, 10))"]);
  if (version?.trim() !== "True") {
    why.python = "there is no Python 3.10 or newer";
  } else {
    why.python = await install(groups.python);
  }
  why.engines = why.python ?? (await install(groups.engines));
  for (const name of Object.keys(groups)) say(`packages of ${name}: ${why[name] ?? "present"}`);
}

/** The visible line of a step that is skipped, or undefined. */
export function skipped(name) {
  if (why[name] === undefined) return undefined;
  const line = `SKIPPED ${name}: ${why[name]}`;
  say(line);
  return line;
}

/** Where the wheel is built. */
const wheels = inRoot("target", "python-wheels");

/** Files of one name may be in several folders, and what was skipped is listed. */
const pytest = ["-v", "-rs", "--import-mode=importlib"];

/**
 * Compiles in half of the time: little is optimised, and no function is inlined across units of code generation. Warnings
 * are refused, as this is where the tests compile the crate as its users do, without the feature `internals`.
 */
const QUICK = {
  CARGO_PROFILE_RELEASE_LTO: "off",
  CARGO_PROFILE_RELEASE_OPT_LEVEL: "1",
  RUSTFLAGS: "-D warnings",
};

/** Builds and installs the wheel, with what differs from one that is published, and tests it as users have it. */
export async function testPython(differences = QUICK) {
  const line = skipped("python");
  if (line !== undefined) return line;
  rmSync(wheels, { recursive: true, force: true });
  // A folder of its own: Cargo writes a library of the kinds cdylib and rlib to one file whatever
  // its features are, and the tests of Rust would be linked with that of the wheel.
  const target = { CARGO_TARGET_DIR: inRoot("target", "python") };
  const options = ["--release", "--locked", "--out", wheels];
  await must(program("maturin"), ["build", ...options], {
    cwd: inRoot("python"),
    env: environment({ ...target, ...differences, VIRTUAL_ENV: home }),
  });
  await installWheel(home);
  await must(program("mypy"), ["--strict", "nurbs_hausdorff"], { cwd: inRoot("python") });
  // Beside the tests, not beside the sources, which are not what users import.
  const cwd = inRoot("python", "tests");
  await must(program("stubtest"), ["nurbs_hausdorff._native"], { cwd });
  return must(program("pytest"), [...pytest, "--ignore=libraries", "."], { cwd });
}

/** Installs the wheel that was built in an environment. */
async function installWheel(folder) {
  const [wheel] = readdirSync(wheels);
  const install = ["install", "--quiet", "--no-deps", "--force-reinstall", join(wheels, wheel)];
  await must(join(folder, "bin", "pip"), install);
}

/** Tests the package with shapes and meshes of other libraries. */
export async function testLibraries() {
  const line = skipped("python");
  if (line !== undefined) return line;
  const outputs = [];
  for (const { name, packages, tests } of libraries) {
    const folder = `${home}-${name}`;
    const imports = [...packages, "pytest"].join(", ");
    const reason = await install({ packages: [...packages, "pytest"], imports }, folder);
    if (reason !== undefined) {
      outputs.push(`SKIPPED libraries: ${packages.join(", ")}: ${reason}`);
      say(outputs.at(-1));
      continue;
    }
    await installWheel(folder);
    const cwd = inRoot("python", "tests", "libraries");
    outputs.push(await must(join(folder, "bin", "pytest"), [...pytest, ...tests], { cwd }));
  }
  return outputs.join("\n");
}
