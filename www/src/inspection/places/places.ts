// The worst place of each face of the maps shown.
import type { DiffResult, FaceDifference } from "nurbs-hausdorff";
import { facesOf } from "../../faces/changes.ts";
import { texts } from "../../texts/index.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import type { FacePlace } from "../../worker/map/places.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../../worker/protocol.ts";

export interface Place extends FacePlace {
  side: Side;
  name: string;
  /** What is certain of the face, once it is known. */
  certified?: FaceDifference;
}

/** Returns one place for every face that has triangles, within what is certain of the face. O(n) in their number. */
export function placesOf(
  maps: Sides<MapDisplay>,
  models: Sides<DisplayModel>,
  bounds: DiffResult | undefined,
): Place[] {
  return SIDES.flatMap((side) => {
    const differences = bounds && facesOf(bounds, side);
    return (maps[side]?.places ?? []).map((place) => {
      const name = models[side]?.faceNames[place.face] ?? texts.places.faceNumber(place.face);
      return boundedPlace({ ...place, side, name }, differences?.[place.face]);
    });
  });
}

/** A place with what is certain of its face: at least and at most as far. */
function boundedPlace(place: Place, certified: FaceDifference | undefined): Place {
  if (certified === undefined) return place;
  const within = (value: number) =>
    Math.sign(value) * Math.min(certified.upper, Math.max(certified.lower, Math.abs(value)));
  const { signed } = place;
  return {
    ...{ ...place, distance: within(place.distance), certified },
    signed: Number.isNaN(signed) ? signed : within(signed),
  };
}
