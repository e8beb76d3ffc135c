// The crates' licences, versions and sources against the lists in deny.toml.
// cargo-deny checks the same by the same lists, but takes minutes to build on a
// clean machine.
import { readFileSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { ask, Failure } from "../process.mjs";

/** The strings of an array of deny.toml. */
function list(toml, name) {
  const array = toml.match(new RegExp(`^${name} = \\[([^\\]]*)\\]`, "m"));
  if (array === null) throw new Failure(`deny.toml has no list ${name}`);
  return [...array[1].matchAll(/"([^"]*)"/g)].map((match) => match[1]);
}

/** The expression with each licence that has an exception as one word. */
const withExceptions = (expression) => expression.replaceAll(/\s+WITH\s+/g, "-WITH-");

/** Whether an SPDX expression can be satisfied with the allowed licences. */
export function isAllowed(expression, allowed) {
  // Cargo also accepts the older form with a slash for OR.
  const tokens = withExceptions(expression.replaceAll("/", " OR ")).match(/[()]|[^()\s]+/g);
  const known = allowed.map(withExceptions);
  let next = 0;
  const one = () => {
    if (tokens[next] !== "(") return known.includes(tokens[next++]);
    next += 1;
    const inner = any();
    next += 1;
    return inner;
  };
  const operands = (operator, operand) => {
    const results = [operand()];
    while (tokens[next] === operator) {
      next += 1;
      results.push(operand());
    }
    return results;
  };
  const all = () => operands("AND", one).every(Boolean);
  const any = () => operands("OR", all).some(Boolean);
  return any();
}

/** The faults of the packages that `cargo metadata` lists. */
export function faults(packages, { licences, skipped, registries }) {
  const found = [];
  const versions = new Map();
  const unused = new Set(skipped);
  for (const { name, version, license, source } of packages) {
    // The package itself.
    if (source === null) continue;
    const id = `${name} ${version}`;
    if (!registries.includes(source.replace(/^registry\+/, "")))
      found.push(`${id} is from ${source}`);
    if (!license) found.push(`${id} states no licence`);
    else if (!isAllowed(license, licences)) found.push(`${id} has the licence ${license}`);
    const skip = skipped.find((skip) => `${name}@${version}.`.startsWith(`${skip}.`));
    if (skip === undefined) versions.set(name, [...(versions.get(name) ?? []), version]);
    else unused.delete(skip);
  }
  for (const [name, list] of versions) {
    if (list.length > 1) found.push(`${name} has the versions ${list.join(", ")}`);
  }
  for (const skip of unused) found.push(`deny.toml skips ${skip}, which is not a dependency`);
  return found;
}

/** What deny.toml accepts. */
export function accepted() {
  const toml = readFileSync(inRoot("deny.toml"), "utf8");
  return {
    licences: list(toml, "allow"),
    skipped: list(toml, "skip"),
    registries: list(toml, "allow-registry"),
  };
}

/** All packages that Cargo.lock names. */
export function packages() {
  const args = ["metadata", "--locked", "--format-version", "1", "--all-features"];
  const metadata = ask("cargo", args, { maxBuffer: 1 << 28 });
  if (metadata === undefined) throw new Failure("cargo metadata failed: is Cargo.lock up to date?");
  return JSON.parse(metadata).packages;
}
