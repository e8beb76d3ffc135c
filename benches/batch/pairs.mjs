// Prints pairs for the command `batch`: node benches/batch/pairs.mjs FOLDER [COUNT] > pairs.jsonl
// Each is of two models of the folder, interchange JSON, half of them of one and the same, moved by
// up to a twentieth of a unit; three in ten are measured in both directions.
import { readdirSync } from "node:fs";
import { join, resolve } from "node:path";

const [folder, count = "10000"] = process.argv.slice(2);
const files = readdirSync(folder)
  .filter((name) => name.endsWith(".json"))
  .sort()
  .map((name) => join(resolve(folder), name));

// The minimal standard generator of Park and Miller, so that pairs are the same everywhere.
let state = 1;
function random() {
  state = (state * 16807) % 2147483647;
  return state / 2147483647;
}
const file = () => files[Math.floor(random() * files.length)];

for (let id = 0; id < Number(count); id++) {
  const a = file();
  const b = random() < 0.5 ? a : file();
  const translation = [random(), random(), random()].map((part) => 0.1 * (part - 0.5));
  console.log(
    JSON.stringify({ id, a, b, transform: { translation }, symmetric: random() < 0.3 }),
  );
}
