// The triangles of a map, coloured by the deviation through a texture.
import { BufferAttribute, BufferGeometry } from "three";
import type { MapDisplay } from "../../worker/map/display.ts";
import { textureCoordinates } from "../colors/scaleTexture.ts";

/** Returns the triangles; deviations are texture coordinates in units of `unit`. */
export function deviationGeometry(map: MapDisplay, unit: number): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(map.positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(map.normals, 3));
  geometry.setAttribute("uv", new BufferAttribute(coordinates(map, unit), 2));
  // A scan has points only.
  if (map.indices.length > 0) geometry.setIndex(new BufferAttribute(map.indices, 1));
  return geometry;
}

/** The texture coordinates of all vertices, or of those named. */
export function coordinates(
  { signed, distances }: MapDisplay,
  unit: number,
  vertices?: Uint32Array,
): Float32Array<ArrayBuffer> {
  const count = vertices?.length ?? signed.length;
  const all = new Float32Array(2 * count);
  const scale = unit > 0 ? 1 / unit : 0;
  for (let index = 0; index < count; index++) {
    const vertex = vertices?.[index] ?? index;
    const [sign, distance] = [signed[vertex] ?? 0, distances[vertex] ?? 0];
    all.set(textureCoordinates(sign * scale, distance * scale), 2 * index);
  }
  return all;
}
