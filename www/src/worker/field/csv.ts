// The samples of A as a table of comma-separated values.
import type { FaceDeviations } from "nurbs-hausdorff";

const HEADER = "face,x,y,z,foot_x,foot_y,foot_z,distance,signed,area";

/** Returns one line a sample. The sign is empty where the closest point has no normal. */
export function csvOf(fields: FaceDeviations[]): Blob {
  const parts = [`${HEADER}\n`];
  for (const { face, points, feet, distances, signed, areas } of fields) {
    for (const [index, distance] of distances.entries()) {
      const sign = signed[index] ?? Number.NaN;
      const numbers = [
        face,
        ...points.subarray(3 * index, 3 * index + 3),
        ...feet.subarray(3 * index, 3 * index + 3),
        distance,
        Number.isNaN(sign) ? "" : sign,
        areas[index] ?? 0,
      ];
      parts.push(`${numbers.join(",")}\n`);
    }
  }
  return new Blob(parts, { type: "text/csv" });
}
