// Triangles between the samples of A, coloured by the deviation from B through a texture.
import { BufferAttribute, BufferGeometry } from "three";
import type { FieldDisplay } from "../../worker/field/fieldDisplay.ts";
import { textureCoordinates } from "../colors/scaleTexture.ts";

/** Returns the triangles; deviations are texture coordinates in units of `unit`. */
export function deviationGeometry(field: FieldDisplay, unit: number): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(field.positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(field.normals, 3));
  geometry.setAttribute("uv", new BufferAttribute(coordinates(field, unit), 2));
  geometry.setIndex(new BufferAttribute(field.indices, 1));
  return geometry;
}

/** The texture coordinates of all samples, or of those named. */
export function coordinates(
  { signed, distances }: FieldDisplay,
  unit: number,
  samples?: Uint32Array,
): Float32Array<ArrayBuffer> {
  const count = samples?.length ?? signed.length;
  const all = new Float32Array(2 * count);
  const scale = unit > 0 ? 1 / unit : 0;
  for (let index = 0; index < count; index++) {
    const sample = samples?.[index] ?? index;
    const [sign, distance] = [signed[sample] ?? 0, distances[sample] ?? 0];
    all.set(textureCoordinates(sign * scale, distance * scale), 2 * index);
  }
  return all;
}
