// Two surfaces compared: how far apart they are at most, and where.
import { Hausdorff } from "nurbs-hausdorff";

/** A bilinear patch over the unit square; x, y, z and the weight of each point, v fastest. */
const patch = (...heights) => ({
  degree: [1, 1],
  counts: [2, 2],
  knotsU: [0, 0, 1, 1],
  knotsV: [0, 0, 1, 1],
  controlPoints: heights.flatMap((z, index) => [index >> 1, index & 1, z, 1]),
});

const hd = await Hausdorff.create();
const a = hd.model([patch(0, 0, 0, 0.25)]);
const b = hd.model([patch(0, 0, 0, 0)]);

const result = await hd.distance(a, b, { symmetric: true, relativeTolerance: 1e-9 });
console.log(`between ${result.lower} and ${result.upper}`);
console.log(`A to B: ${result.forward.upper}, B to A: ${result.reverse.upper}`);
const { point, u, v } = result.witness.a;
console.log(`farthest at ${point}, u ${u}, v ${v}`);

for (const owner of [a, b, hd]) owner.dispose();
