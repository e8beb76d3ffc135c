// The package as users get it: packed, and installed in a temporary folder.
import {
  cpSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  realpathSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { buildCommand, command } from "../../scripts/build/command.mjs";
import { packCommand, packPackage } from "../../scripts/build/tarballs.mjs";
import { inRoot } from "../../scripts/paths.mjs";
import { must } from "../../scripts/process.mjs";

const apps = inRoot("tests", "package", "app");

/** Packs the built package and this platform's command, and installs both in a new folder. */
export async function install() {
  const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
  await buildCommand();
  const platform = `${process.platform}-${process.arch}`;
  const tarballs = [await packPackage(folder), await packCommand(platform, command, folder)];
  writeFileSync(join(folder, "package.json"), JSON.stringify({ private: true, type: "module" }));
  // Offline: the commands of other platforms are asked of no registry.
  const quiet = ["--ignore-scripts", "--offline", "--no-audit", "--no-fund", "--silent"];
  await must("npm", ["install", ...quiet, ...tarballs], { cwd: folder });
  const [tarball] = tarballs;
  return {
    folder,
    tarball,
    installed: join(folder, "node_modules", "nurbs-hausdorff"),
    installPeers: () => installPeers(join(folder, "node_modules")),
    remove: () => rmSync(folder, { recursive: true }),
  };
}

/** Puts the optional peers of this checkout beside the installed package. */
function installPeers(modules) {
  mkdirSync(join(modules, "@bitbybit-dev"), { recursive: true });
  const links = ["rhino3dm", "@bitbybit-dev/occt"].map((name) => {
    const link = join(modules, name);
    symlinkSync(realpathSync(inRoot("node_modules", name)), link, "dir");
    return link;
  });
  return {
    remove() {
      for (const link of links) rmSync(link);
    },
  };
}

/** Copies the programs and what they share to `name` in the folder, where they import the entry `from`, and returns their folder. */
export function program(folder, name, from) {
  const source = join(folder, name, "src");
  cpSync(apps, source, { recursive: true });
  for (const entry of readdirSync(source, { withFileTypes: true })) {
    if (!entry.isFile()) continue;
    const file = join(source, entry.name);
    writeFileSync(file, readFileSync(file, "utf8").replaceAll("PACKAGE", from));
  }
  return source;
}

/** A page that runs a module script, preceded by `head`. */
export function page(path, script, head = "") {
  const body = `<script type="module" src="${script}"></script>`;
  writeFileSync(path, `<!doctype html><meta charset="utf-8"><title>test</title>${head}${body}`);
}
