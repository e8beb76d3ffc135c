// The triangles of a map, coloured by the deviation through a texture.
import { BufferAttribute, BufferGeometry } from "three";
import type { MapDisplay } from "../../worker/map/display.ts";
import { setBounds } from "../bounds.ts";

/** Returns the triangles of a map. */
export function deviationGeometry(map: MapDisplay): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(map.positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(map.normals, 3));
  geometry.setAttribute("uv", new BufferAttribute(map.coordinates, 2));
  // A scan has points only.
  if (map.indices.length > 0) geometry.setIndex(new BufferAttribute(map.indices, 1));
  setBounds(geometry, map.bounds);
  return geometry;
}
