// The packages as they are published: that of a platform's command, and the one that users install,
// which has those of all platforms as optional dependencies.
import {
  chmodSync,
  copyFileSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { inRoot } from "../paths.mjs";
import { ask, Failure, must } from "../process.mjs";

/** The platforms with a command, as Node names them; those of `.github/workflows/release.yml`. */
export const PLATFORMS = ["linux-x64", "linux-arm64", "darwin-x64", "darwin-arm64", "win32-x64"];

const manifest = () => JSON.parse(readFileSync(inRoot("package.json"), "utf8"));
const platformPackage = (platform) => `@nurbs-hausdorff/${platform}`;

/** Packs what `fill` writes into a folder, and returns the tarball in the folder `target`. */
async function packed(target, fill) {
  const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-pack-"));
  try {
    fill(folder);
    const args = ["pack", "--ignore-scripts", "--json", "--pack-destination", target];
    const printed = await must("npm", args, { cwd: folder });
    return join(target, JSON.parse(printed)[0].filename);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Packs a platform's command. */
export function packCommand(platform, program, target) {
  if (!PLATFORMS.includes(platform)) {
    throw new Failure(`unknown platform ${platform}, expected one of ${PLATFORMS.join(", ")}`);
  }
  const { version, license } = manifest();
  const [os, cpu] = platform.split("-");
  return packed(target, (folder) => {
    const file = join(folder, basename(program));
    copyFileSync(program, file);
    chmodSync(file, 0o755);
    for (const name of ["LICENSE-MIT", "LICENSE-APACHE"]) {
      copyFileSync(inRoot(name), join(folder, name));
    }
    const about = `The command of nurbs-hausdorff for ${platform}`;
    writeFileSync(join(folder, "README.md"), `${about}. Install \`nurbs-hausdorff\` instead.\n`);
    const own = { name: platformPackage(platform), version, description: about, license };
    // The program is of the GNU C library, as those of the release are.
    const libc = os === "linux" ? { libc: ["glibc"] } : {};
    const rest = { os: [os], cpu: [cpu], ...libc, preferUnplugged: true };
    writeFileSync(join(folder, "package.json"), JSON.stringify({ ...own, ...rest }, null, 2));
  });
}

/** Packs the package, with the modules that were built before. */
export function packPackage(target) {
  const listed = ask("npm", ["pack", "--dry-run", "--json", "--ignore-scripts"]);
  if (listed === undefined) throw new Failure("npm cannot list the files of the package");
  const { private: _, scripts: __, devDependencies: ___, ...published } = manifest();
  const versions = PLATFORMS.map((platform) => [platformPackage(platform), published.version]);
  return packed(target, (folder) => {
    for (const { path } of JSON.parse(listed)[0].files) {
      mkdirSync(dirname(join(folder, path)), { recursive: true });
      copyFileSync(inRoot(path), join(folder, path));
    }
    const complete = { ...published, optionalDependencies: Object.fromEntries(versions) };
    writeFileSync(join(folder, "package.json"), JSON.stringify(complete, null, 2));
  });
}
