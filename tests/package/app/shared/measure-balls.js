import { ball } from "./ball.js";

/** Reads two balls 0.2 apart from STEP files, and measures them. */
export async function measureBalls(
  Hausdorff,
  options = {},
  readCad = (hd, bytes) => hd.readCad(bytes),
) {
  try {
    const hd = await Hausdorff.create({ backend: "cpu", ...options });
    const [a, b] = await Promise.all([1, 1.2].map((radius) => readCad(hd, ball(radius))));
    const { lower, upper } = await hd.distance(a, b);
    hd.dispose();
    return { lower, upper };
  } catch (error) {
    return { error: `${error.code}: ${error.message}` };
  }
}
