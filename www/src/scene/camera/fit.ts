// The camera distance at which a box fits the view.
import { type Box3, Matrix4, type PerspectiveCamera, Vector3 } from "three";

/** The fraction of the view that the box fills. */
const FILL = 0.92;
const UPRIGHT = new Vector3(0, 1, 0);

/**
 * Returns the smallest distance from the box's centre, in `direction`, at which all its corners are in view,
 * within the parts `free` of its width and height about its middle.
 */
export function fitDistance(
  camera: PerspectiveCamera,
  direction: Vector3,
  box: Box3,
  [freeWidth, freeHeight] = [1, 1],
): number {
  const center = box.getCenter(new Vector3());
  // Seen from above or below, the controls show the axis y upright.
  const isVertical = new Vector3().crossVectors(direction, camera.up).lengthSq() === 0;
  const up = isVertical ? UPRIGHT : camera.up;
  const rotation = new Matrix4().lookAt(direction, new Vector3(), up).invert();
  const tangent = FILL * Math.tan((camera.fov * Math.PI) / 360);
  const horizontal = tangent * camera.aspect * freeWidth;
  const vertical = tangent * freeHeight;
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const position = new Vector3(
      corner & 1 ? box.max.x : box.min.x,
      corner & 2 ? box.max.y : box.min.y,
      corner & 4 ? box.max.z : box.min.z,
    )
      .sub(center)
      .applyMatrix4(rotation);
    const required = Math.max(Math.abs(position.x) / horizontal, Math.abs(position.y) / vertical);
    distance = Math.max(distance, position.z + required);
  }
  return distance;
}
