// How far to stand back for a whole box to be seen.
import { type Box3, Matrix4, type PerspectiveCamera, Vector3 } from "three";

/** Part of the view that the box fills. */
const FILL = 0.92;

/** The distance from the box's centre, looking from `direction`, at which every corner is seen. */
export function fitted(camera: PerspectiveCamera, direction: Vector3, box: Box3): number {
  const center = box.getCenter(new Vector3());
  const turned = new Matrix4().lookAt(direction, new Vector3(), camera.up).invert();
  const vertical = FILL * Math.tan((camera.fov * Math.PI) / 360);
  const horizontal = vertical * camera.aspect;
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const seen = new Vector3(
      corner & 1 ? box.max.x : box.min.x,
      corner & 2 ? box.max.y : box.min.y,
      corner & 4 ? box.max.z : box.min.z,
    )
      .sub(center)
      .applyMatrix4(turned);
    const needed = Math.max(Math.abs(seen.x) / horizontal, Math.abs(seen.y) / vertical);
    distance = Math.max(distance, seen.z + needed);
  }
  return distance;
}
