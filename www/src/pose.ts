// Where model A stands.
import type { Transform } from "nurbs-hausdorff";
import { Matrix4, Quaternion, Vector3 } from "three";

const UP = new Vector3(0, 0, 1);

/** A turned about its own middle's vertical axis, then moved. */
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

  /** As the package takes it. */
  get transform(): Transform {
    const { x, y, z, w } = this.#rotation;
    return { rotation: [x, y, z, w], translation: this.#translation.toArray() };
  }

  /** As the scene takes it, for a mesh around `origin` in a scene around `center`. */
  matrix(origin: Vector3, center: Vector3): Matrix4 {
    const position = origin
      .clone()
      .applyQuaternion(this.#rotation)
      .add(this.#translation)
      .sub(center);
    return new Matrix4().compose(position, this.#rotation, new Vector3(1, 1, 1));
  }
}
