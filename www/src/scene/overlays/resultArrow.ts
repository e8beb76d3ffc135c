// The arrow of a result, in the direction in which its distance is attained.
import type { DistanceResult, Vector3 as Point } from "nurbs-hausdorff";
import { farthestSide } from "../../common/direction.ts";
import { placeName } from "../../common/text/names.ts";
import { certifiedText } from "../../common/text/numbers.ts";
import type { ArrowTexts } from "./arrow.ts";

/** Returns the ends of a result's arrow, and what its labels say. */
export function arrowOf(result: DistanceResult): { from: Point; to: Point; texts: ArrowTexts } {
  const { witness, computed, lower, upper, diagonal } = result;
  const fromA = farthestSide(result) === "a";
  const [from, to] = fromA ? [witness.a, witness.b] : [witness.b, witness.a];
  const [own, other] = fromA ? ["A", "B"] : ["B", "A"];
  const texts = {
    length: certifiedText(computed, [lower, upper], diagonal),
    from: `${own}: ${placeName(from)}`,
    to: `${other}: ${placeName(to)}`,
  };
  return { from: from.point, to: to.point, texts };
}
