// The side from which a place is seen: normals of files point to either side of their faces.
import { Vector3 } from "three";
import type { Models } from "../../scene/models.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import type { Side } from "../../worker/protocol.ts";

/** How far beside a triangle its sides are tested, in diagonals: beyond the rounding of float32. */
const BESIDE = 1e-5;
/** What is added to the direction of rays, so that not all of them meet one edge. */
const TILTS = [new Vector3(), new Vector3(0.13, 0.07, -0.11), new Vector3(-0.05, 0.17, 0.09)];

/**
 * Returns the normal of a map's vertex in the scene, turned away from the inside of its own model where that is
 * closed. A triangle at the vertex decides: the vertex itself may lie on the border of other faces.
 */
export function outwardNormal(
  models: Models,
  map: MapDisplay,
  { side, vertex }: { side: Side; vertex: number },
): Vector3 {
  const at = (all: Float32Array, index: number): [number, number, number] => {
    const [x = 0, y = 0, z = 0] = all.subarray(3 * index, 3 * index + 3);
    return [x, y, z];
  };
  const normal = models.turn(side, at(map.normals, vertex));
  const first = 3 * Math.floor(map.indices.indexOf(vertex) / 3);
  // Points of a scan have no triangles.
  if (first < 0) return normal;
  const [a, b, c] = [0, 1, 2].map((corner) =>
    models.place(side, at(map.positions, map.indices[first + corner] ?? 0)),
  ) as [Vector3, Vector3, Vector3];
  const across = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
  if (across.dot(normal) < 0) across.negate();
  const middle = a.clone().add(b).add(c).divideScalar(3);
  const isInside = (way: Vector3) => {
    const from = middle.clone().addScaledVector(way, BESIDE * models.diagonal);
    const odd = TILTS.filter(
      (tilt) => models.crossings(side, from, way.clone().add(tilt)) % 2 === 1,
    );
    return 2 * odd.length > TILTS.length;
  };
  const back = across.clone().negate();
  return isInside(across) && !isInside(back) ? normal.negate() : normal;
}
