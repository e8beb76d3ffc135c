// node scripts/pack.mjs FOLDER: builds the package and packs it, as it is published, into a folder.
// node scripts/pack.mjs FOLDER PLATFORM PROGRAM: packs a platform's command, as linux-x64.
import { mkdirSync } from "node:fs";
import { resolve } from "node:path";
import { buildPackage } from "./build/index.mjs";
import { packCommand, packPackage } from "./build/tarballs.mjs";
import { Failure } from "./process.mjs";
import { setUpForPage } from "./setup/index.mjs";

const [folder, platform, program] = process.argv.slice(2);

async function pack() {
  if (folder === undefined) throw new Failure("expected a folder for the tarball");
  const target = resolve(folder);
  mkdirSync(target, { recursive: true });
  if (program !== undefined) return packCommand(platform, resolve(program), target);
  await setUpForPage();
  await buildPackage();
  return packPackage(target);
}

try {
  console.log(`packed ${await pack()}`);
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
