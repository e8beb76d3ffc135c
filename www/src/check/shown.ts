// The bodies of a check in the view: alone, seen through, with the place that matters marked.
import type { Transform } from "nurbs-hausdorff";
import type { FaceTree } from "../faces/faceTree.ts";
import type { FaceClass } from "../scene/faces.ts";
import type { ShownArrow } from "../scene/shown/display.ts";
import type { View } from "../scene/view.ts";
import type { Side } from "../worker/protocol.ts";
import { moved } from "../worker/rigid.ts";
import type { ShownBodies } from "./checkPanel.ts";

/** Shows these bodies alone; without any, the models and their result again. `transform` moves A. */
export function showBodies(
  { view, tree }: { view: View; tree: FaceTree },
  shown: ShownBodies | undefined,
  transform: Transform,
): void {
  if (shown === undefined) {
    tree.isolate(undefined);
    view.showBodies();
    view.back();
    return;
  }
  const faces: Record<Side, number[]> = { a: [], b: [] };
  const classes: Record<Side, FaceClass[]> = { a: [], b: [] };
  for (const [index, body] of shown.bodies.entries()) {
    faces[body.side].push(...body.faces);
    // Of two bodies of one model, the second is grey.
    const isSecond = index > 0 && shown.bodies[0]?.side === body.side;
    for (const face of body.faces) classes[body.side][face] = isSecond ? "plain" : "own";
  }
  tree.isolate(faces);
  const arrow = shown.place && markOf(shown.place, view.models.scale, transform);
  view.showBodies({ classes, arrow });
  view.approachFaces(faces);
}

/** The mark of a place in the scene, from the coordinates of what was checked. */
function markOf(
  { point, of, text }: NonNullable<ShownBodies["place"]>,
  scale: number,
  transform: Transform,
): ShownArrow {
  const [x, y, z] = point;
  const at = of === "b" ? ([scale * x, scale * y, scale * z] as const) : point;
  const placed = of === "a" ? moved([...point], transform) : at;
  return { from: [...placed], to: [...placed], texts: { length: text, from: "", to: "" } };
}
