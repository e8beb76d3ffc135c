// What is shown of each model where the user leaves it to the page.
import type { DistanceResult } from "nurbs-hausdorff";
import { farthestSide } from "../common/direction.ts";
import type { Visibility } from "../scene/mesh.ts";
import type { Models } from "../scene/models.ts";
import type { Side } from "../worker/protocol.ts";
import { display } from "./display.ts";
import { overlays, paint } from "./options.ts";

/** The distance, in diagonals, up to which models cover each other. */
const NEARLY = 0.05;

/**
 * Returns what is shown of the models, so that nothing hides what is painted: of models that nearly
 * coincide, the one with the farthest point is solid, and one that encloses the other is not.
 * `shown` are the models that are painted, where it is known.
 */
export function visibilities(
  { outer: enclosing }: Models,
  result: DistanceResult | undefined,
  shown: readonly Side[] | undefined,
): Record<Side, Visibility> {
  const { lines, deviation: colours } = overlays.value;
  const painted = colours ? (shown ?? paint.value) : (["a"] as const);
  const { wipe, visibility } = display.value;
  const wiped = wipe !== undefined;
  const near = result === undefined || result.computed < NEARLY * result.diagonal;
  const covers = painted.length > 1 && near && !wiped;
  const farthest = result === undefined ? "a" : farthestSide(result);
  const front = covers ? [farthest] : painted;
  const outer = wiped ? undefined : enclosing;
  const auto = (side: Side): Visibility =>
    side === outer || !front.includes(side) ? "glass" : "solid";
  // Lines inside a model are seen through it.
  const isBeside = wipe?.isBeside ?? false;
  const of = (side: Side): Visibility => {
    // Side by side, neither hides the other.
    const shown = visibility[side] ?? (isBeside ? "solid" : auto(side));
    return lines && shown === "solid" ? "glass" : shown;
  };
  return { a: of("a"), b: of("b") };
}
