// node files.mjs A.json B.json 0.001: which faces of two files differ by more than
// 0.001, how far and where.
import { readFileSync } from "node:fs";
import { Hausdorff } from "nurbs-hausdorff";

const [first, second, limit] = process.argv.slice(2);
const hd = await Hausdorff.create();
const [a, b] = [first, second].map((file) => hd.model(readFileSync(file, "utf8")));
const result = await hd.diff(a, b, { limit: Number(limit) });
for (const [name, faces] of [
  ["A", result.facesOfA],
  ["B", result.facesOfB],
]) {
  for (const { face, state, upper, witness } of faces) {
    const where = name === "A" ? witness.a.point : witness.b.point;
    console.log(`${name}, face ${face}: ${state}, at most ${upper}, largest at ${where}`);
  }
}
console.log(`the models are ${result.state}`);
for (const owner of [a, b, hd]) owner.dispose();
