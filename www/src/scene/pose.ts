// The position and orientation of model A.
import type { Transform } from "nurbs-hausdorff";
import { Matrix4, Quaternion, Vector3 } from "three";

const UP = new Vector3(0, 0, 1);

/** A rotation of A about the vertical axis through its centre, followed by a translation. */
export class Pose {
  readonly #rotation: Quaternion;
  readonly #translation: Vector3;

  constructor(move: Vector3, degrees: number, middle: Vector3) {
    this.#rotation = new Quaternion().setFromAxisAngle(UP, (degrees * Math.PI) / 180);
    this.#translation = middle
      .clone()
      .sub(middle.clone().applyQuaternion(this.#rotation))
      .add(move);
  }

  /** The pose as the package's transform. */
  get transform(): Transform {
    const { x, y, z, w } = this.#rotation;
    return { rotation: [x, y, z, w], translation: this.#translation.toArray() };
  }

  /** The pose as a matrix, for a mesh relative to `origin` in a scene relative to `center`. */
  matrix(origin: Vector3, center: Vector3): Matrix4 {
    const position = origin
      .clone()
      .applyQuaternion(this.#rotation)
      .add(this.#translation)
      .sub(center);
    return new Matrix4().compose(position, this.#rotation, new Vector3(1, 1, 1));
  }
}
