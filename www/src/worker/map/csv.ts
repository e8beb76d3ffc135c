// The vertices of maps as a table of comma-separated values.
import type { DeviationMap, Vector3 } from "nurbs-hausdorff";
import type { Side } from "../protocol.ts";
import { triangleAreas } from "./distribution.ts";
import { type Placing, placed } from "./placed.ts";

const HEADER = "side,face,x,y,z,foot_x,foot_y,foot_z,distance,signed,area";

/** A map with the model that it is of. */
export interface MapOf {
  side: Side;
  map: DeviationMap;
  placing: Placing;
}

/** Returns one line a vertex. The sign is empty where the closest point has no normal. */
export function csvOf(maps: MapOf[]): Blob {
  return new Blob([`${HEADER}\n`, ...maps.flatMap(linesOf)], { type: "text/csv" });
}

function linesOf({ side, map, placing }: MapOf): string[] {
  const { points, feet, distances, signed } = map;
  const { faces, areas } = ofVertices(map, side === "b" ? placing.scale : 1);
  const lines: string[] = [];
  for (const [vertex, distance] of distances.entries()) {
    const at = (all: Float64Array): Vector3 => [
      all[3 * vertex] ?? 0,
      all[3 * vertex + 1] ?? 0,
      all[3 * vertex + 2] ?? 0,
    ];
    const sign = signed[vertex] ?? Number.NaN;
    const numbers = [
      ...[side.toUpperCase(), faces[vertex], ...placed(side, at(points), placing), ...at(feet)],
      ...[distance, Number.isNaN(sign) ? "" : sign, areas[vertex] ?? 0],
    ];
    lines.push(`${numbers.join(",")}\n`);
  }
  return lines;
}

/** The face of every vertex, and the area that it stands for: a third of its triangles'. */
function ofVertices(map: DeviationMap, scale: number) {
  const count = map.distances.length;
  const [faces, areas] = [new Uint32Array(count), new Float64Array(count)];
  const { indices, faces: owners } = map;
  for (const [triangle, area] of triangleAreas(map).entries()) {
    for (const vertex of indices.subarray(3 * triangle, 3 * triangle + 3)) {
      faces[vertex] = owners[triangle] ?? 0;
      areas[vertex] = (areas[vertex] ?? 0) + (scale * scale * area) / 3;
    }
  }
  return { faces, areas };
}
