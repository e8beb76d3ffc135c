// A surface that deforms, measured against a fixed one frame after frame: its control
// points change, and its knots stay.
import { Hausdorff } from "nurbs-hausdorff";

const [rows, columns, degree] = [14, 13, 3];
const knots = (count) =>
  Array.from({ length: count + degree + 1 }, (_, index) =>
    Math.min(Math.max(index - degree, 0), count - degree),
  );

/** The control points of a wave at a time. */
function wave(time) {
  return Array.from({ length: rows * columns }, (_, index) => {
    const [x, y] = [Math.floor(index / columns) / (rows - 1), (index % columns) / (columns - 1)];
    return [x, y, 0.1 * Math.sin(6 * x + time), 1];
  }).flat();
}

const sheet = {
  degree: [degree, degree],
  counts: [rows, columns],
  knotsU: knots(rows),
  knotsV: knots(columns),
  controlPoints: wave(0),
};
const hd = await Hausdorff.create({ backend: "cpu" });
const [fixed, moving] = [hd.model([sheet]), hd.model([sheet])];
for (let frame = 0; frame < 10; frame++) {
  moving.update(0, wave(0.1 * frame));
  const { lower, upper } = await hd.distance(moving, fixed, { relativeTolerance: 1e-4 });
  console.log(`frame ${frame}: between ${lower.toFixed(5)} and ${upper.toFixed(5)}`);
}
for (const owner of [fixed, moving, hd]) owner.dispose();
