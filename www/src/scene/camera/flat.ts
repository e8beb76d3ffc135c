// The orthographic camera, which follows the one with perspective.
import type { OrthographicCamera, PerspectiveCamera } from "three";

/** Has the flat camera see the same as the other one at its target; `height` is half of what is seen there. */
export function followFlat(flat: OrthographicCamera, eye: PerspectiveCamera, height: number): void {
  const { aspect } = eye;
  flat.position.copy(eye.position);
  flat.quaternion.copy(eye.quaternion);
  Object.assign(flat, { left: -height * aspect, right: height * aspect });
  // An orthographic view has no nearest point: what lies behind the eye is shown too.
  Object.assign(flat, { top: height, bottom: -height, near: -eye.far, far: eye.far });
  flat.updateProjectionMatrix();
  flat.updateMatrixWorld();
}
