// What places of models are called.

import type { SurfacePoint } from "nurbs-hausdorff";
import { texts } from "../../texts/index.ts";

/** The place of a point by its face's name in the source; on a mesh its triangle, of a scan its point. */
export function placeName({ face, faceName, triangle, index }: SurfacePoint): string {
  const own =
    index === undefined
      ? triangle === undefined
        ? undefined
        : texts.common.triangle(triangle)
      : texts.common.point(index);
  if (faceName === undefined) return own ?? texts.common.face(face);
  return own === undefined ? faceName : `${faceName}, ${own}`;
}
