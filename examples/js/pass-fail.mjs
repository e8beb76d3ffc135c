// node pass-fail.mjs A.json B.json 0.01: whether every point of each model is within
// 0.01 of the other. Only the question is decided, which is much faster than the
// distance. Exit status 0: yes, 1: no, 3: undecided, 2: wrong input.
import { readFileSync } from "node:fs";
import { Hausdorff, HausdorffError } from "nurbs-hausdorff";

const [first, second, limit] = process.argv.slice(2);
try {
  const hd = await Hausdorff.create();
  const [a, b] = [first, second].map((file) => hd.model(readFileSync(file, "utf8")));
  const { within, lower, upper } = await hd.distance(a, b, {
    limit: Number(limit),
    symmetric: true,
    maxSeconds: 60,
  });
  const verdict = within === undefined ? "undecided" : within ? "within" : "beyond";
  console.log(`${verdict} ${limit}: the distance is between ${lower} and ${upper}`);
  process.exitCode = { within: 0, beyond: 1, undecided: 3 }[verdict];
} catch (error) {
  if (!(error instanceof HausdorffError)) throw error;
  console.error(`${error.code}: ${error.message}`);
  process.exitCode = 2;
}
