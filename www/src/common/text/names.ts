// What places of models are called.
import type { SurfacePoint } from "nurbs-hausdorff";

/** The place of a point by its face's name in the source; on a mesh its triangle, of a scan its point. */
export function placeName({ face, faceName, triangle, index }: SurfacePoint): string {
  const own =
    index === undefined
      ? triangle === undefined
        ? undefined
        : `triangle ${triangle}`
      : `point ${index}`;
  if (faceName === undefined) return own ?? `face ${face}`;
  return own === undefined ? faceName : `${faceName}, ${own}`;
}
