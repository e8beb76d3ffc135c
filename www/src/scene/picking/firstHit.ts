// What is seen at a position in the window: the model that the view's ray hits first.
import type { Intersection, Plane } from "three";
import { SIDES, type Side, type Sides } from "../../worker/protocol.ts";
import type { Viewport } from "../camera/viewport.ts";
import type { ModelMesh } from "../mesh.ts";

export interface FirstHit {
  side: Side;
  hit: Intersection;
  mesh: ModelMesh;
}

/** Returns what is hit first of models that are drawn and not cut away. */
export function firstHit(
  meshes: Sides<ModelMesh>,
  planes: readonly Plane[],
  viewport: Viewport,
  [clientX, clientY]: readonly [number, number],
): FirstHit | undefined {
  const alone = viewport.sideAt(clientX);
  const visible = SIDES.filter(
    (side) => meshes[side]?.group.visible && (alone === undefined || alone === side),
  );
  const targets = visible.flatMap((side) => meshes[side]?.target ?? []);
  const sideOf = (object: unknown) => visible.find((side) => meshes[side]?.target === object);
  const isDrawn = (hit: Intersection) => {
    const mesh = meshes[sideOf(hit.object) ?? "a"];
    return mesh?.draws(mesh.faceHit(hit)) ?? false;
  };
  const hits = viewport
    .hits(clientX, clientY, targets)
    .filter(({ point }) => planes.every((plane) => plane.distanceToPoint(point) >= 0))
    .filter(isDrawn);
  // What is seen through is meant only where nothing else is.
  const hit =
    hits.find(({ object }) => meshes[sideOf(object) ?? "a"]?.visibility === "solid") ?? hits[0];
  const side = sideOf(hit?.object);
  const mesh = side && meshes[side];
  if (hit === undefined || side === undefined || mesh === undefined) return undefined;
  return { side, hit, mesh };
}
