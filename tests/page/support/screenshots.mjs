// The screenshots that tests take, for people to look at.
import { mkdirSync, writeFileSync } from "node:fs";

const folder = "tests/screenshots";

/** Keeps a picture, PNG, under a name. */
export function saveScreenshot(name, picture) {
  mkdirSync(folder, { recursive: true });
  writeFileSync(`${folder}/${name}.png`, picture);
}
