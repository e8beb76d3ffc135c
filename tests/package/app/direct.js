// A program that measures on its own thread; PACKAGE is the entry under test.
import { Hausdorff } from "PACKAGE";

async function measure() {
  const hd = await Hausdorff.create({ backend: "cpu" });
  const [a, b] = ["sphere", "sphere-larger"].map((name) => hd.shape(name));
  const { lower, upper } = await hd.distance(a, b);
  for (const owner of [a, b, hd]) owner.dispose();
  return { lower, upper };
}

globalThis.outcome = measure().catch((error) => ({ error: `${error.code}: ${error.message}` }));
