// The page draws the scale of deviations by three.js and the pictures of reports by a rasteriser in Rust: no code that both
// have could hold its colours.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { inRoot } from "../paths.mjs";

const ofPage = readFileSync(inRoot("www", "src", "scene", "colors", "scale.ts"), "utf8");
const ofPictures = readFileSync(inRoot("crates", "pictures", "src", "scale.rs"), "utf8");

/** Returns the colours that a constant lists, as six digits each. */
function colours(text, name) {
  const [, list] = text.match(new RegExp(`const ${name}\\b(.*?);\\n(?=\\n|const|/)`, "s")) ?? [];
  assert.ok(list, `${name} is a constant`);
  return [...list.matchAll(/(?:#|0x)([0-9a-f]{6})\b/g)].map(([, digits]) => digits);
}

for (const name of ["DIVERGING", "SEQUENTIAL", "UNSIGNED", "WITHIN", "ROUNDING"]) {
  test(`${name.toLowerCase()} colours are those of the page in pictures`, () => {
    const expected = colours(ofPage, name);
    assert.notEqual(expected.length, 0);
    assert.deepEqual(colours(ofPictures, name), expected);
  });
}
