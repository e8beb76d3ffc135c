// Which point of a cloud a ray hits: of those whose discs cover the pointer, the one that is drawn in front.
import {
  type Box3,
  type Intersection,
  type Material,
  Matrix4,
  type Points,
  type Ray,
  type Raycaster,
  Vector3,
} from "three";
import { Tree } from "./tree.ts";

/** A ray in the coordinates of a cloud, and the radius of a disc where it is this far away. */
interface Beam {
  ray: Ray;
  radiusAt: (distance: number) => number;
}

/**
 * Finds the point that a ray hits: by a tree once it is built, and until then one by one. The raycaster's threshold for
 * points is the radius of their discs, of a perspective camera at the distance 1.
 */
export class PointHits {
  readonly #points: Points;
  readonly #positions: Float32Array;
  readonly #tree: Tree;

  /** Takes over the points' `raycast`. */
  constructor(points: Points, positions: Float32Array) {
    this.#points = points;
    this.#positions = positions;
    this.#tree = new Tree({ positions, indices: new Uint32Array() }, points.geometry);
    points.raycast = (ray, hits) => this.#raycast(ray, hits);
  }

  dispose(): void {
    this.#tree.dispose();
  }

  #raycast(raycaster: Raycaster, hits: Intersection[]): void {
    const { matrixWorld } = this.#points;
    const beam = beamOf(raycaster, matrixWorld);
    const nearest = new Nearest(beam, this.#positions, (point) => this.#isDrawn(point));
    const tree = this.#tree.built;
    if (tree === undefined) nearest.search(this.#positions.length / 3, (index) => index);
    else {
      tree.shapecast({
        boundsTraverseOrder: (box) => box.distanceToPoint(beam.ray.origin),
        intersectsBounds: (box) => nearest.mayBeIn(box),
        intersectsRange: (offset, count) => {
          nearest.search(count, (index) => tree.resolveTriangleIndex(offset + index));
          return false;
        },
      });
    }
    const { index } = nearest;
    if (index === undefined) return;
    const point = new Vector3().fromArray(this.#positions, 3 * index).applyMatrix4(matrixWorld);
    hits.push({
      ...{ distance: raycaster.ray.origin.distanceTo(point), point, index },
      object: this.#points,
    });
  }

  /** Whether no plane cuts a point of the cloud away. */
  #isDrawn(point: Vector3): boolean {
    const planes = (this.#points.material as Material).clippingPlanes ?? [];
    if (planes.length === 0) return true;
    const at = point.clone().applyMatrix4(this.#points.matrixWorld);
    return planes.every((plane) => plane.distanceToPoint(at) >= 0);
  }
}

function beamOf({ ray, params, camera }: Raycaster, matrixWorld: Matrix4): Beam {
  const { threshold } = params.Points;
  const scale = matrixWorld.getMaxScaleOnAxis();
  return {
    ray: ray.clone().applyMatrix4(new Matrix4().copy(matrixWorld).invert()),
    radiusAt:
      camera.type === "OrthographicCamera"
        ? () => threshold / scale
        : (distance) => threshold * distance,
  };
}

/** The point nearest to the eye of those searched whose discs a beam hits. */
class Nearest {
  index: number | undefined;
  readonly #beam: Beam;
  readonly #positions: Float32Array;
  readonly #isDrawn: (point: Vector3) => boolean;
  #depth = Number.POSITIVE_INFINITY;

  constructor(beam: Beam, positions: Float32Array, isDrawn: (point: Vector3) => boolean) {
    this.#beam = beam;
    this.#positions = positions;
    this.#isDrawn = isDrawn;
  }

  /** Whether a point in a box may be hit and nearer. */
  mayBeIn(box: Box3): boolean {
    const { ray, radiusAt } = this.#beam;
    // A point that is hit is beside the ray by a radius at most.
    const reach = Math.hypot(this.#depth, radiusAt(this.#depth));
    if (box.distanceToPoint(ray.origin) >= reach) return false;
    const farthest =
      box.getCenter(new Vector3()).distanceTo(ray.origin) + box.min.distanceTo(box.max) / 2;
    return ray.intersectsBox(box.clone().expandByScalar(radiusAt(farthest)));
  }

  /** Searches some points, by their numbers. O(n). */
  search(count: number, numberOf: (index: number) => number): void {
    const { ray, radiusAt } = this.#beam;
    const { origin, direction } = ray;
    const positions = this.#positions;
    for (let at = 0; at < count; at++) {
      const index = numberOf(at);
      const x = (positions[3 * index] ?? 0) - origin.x;
      const y = (positions[3 * index + 1] ?? 0) - origin.y;
      const z = (positions[3 * index + 2] ?? 0) - origin.z;
      const depth = x * direction.x + y * direction.y + z * direction.z;
      if (depth <= 0 || depth >= this.#depth) continue;
      const aside = x * x + y * y + z * z - depth * depth;
      if (aside > radiusAt(depth) ** 2) continue;
      if (!this.#isDrawn(new Vector3().fromArray(positions, 3 * index))) continue;
      this.#depth = depth;
      this.index = index;
    }
  }
}
