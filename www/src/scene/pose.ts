// The position and orientation of model A.
import type { Transform } from "nurbs-hausdorff";
import { Euler, MathUtils, Matrix4, Quaternion, Vector3 } from "three";

/** Rotations about the fixed axes x, y, z, in this order. */
const ORDER = "ZYX";

/** A rotation of A about the centre of its box, followed by a translation. */
export class Pose {
  readonly move: Vector3;
  readonly rotation: Quaternion;
  readonly #middle: Vector3;
  readonly #translation: Vector3;

  /** `degrees` are the angles about x, y and z, applied in this order; `middle` is the centre of A's box. */
  constructor(move: Vector3, degrees: Vector3, middle: Vector3) {
    const [x, y, z] = degrees.toArray().map(MathUtils.degToRad);
    this.move = move;
    this.rotation = new Quaternion().setFromEuler(new Euler(x, y, z, ORDER));
    this.#middle = middle;
    this.#translation = middle.clone().sub(middle.clone().applyQuaternion(this.rotation)).add(move);
  }

  /** Returns the pose of a transform. */
  static of({ rotation, translation }: Transform, middle: Vector3): Pose {
    const quaternion = new Quaternion(...(rotation ?? [0, 0, 0, 1]));
    const move = new Vector3(...(translation ?? [0, 0, 0]))
      .add(middle.clone().applyQuaternion(quaternion))
      .sub(middle);
    return new Pose(move, degreesOf(quaternion), middle);
  }

  /** The pose as the package's transform. */
  get transform(): Transform {
    const { x, y, z, w } = this.rotation;
    return { rotation: [x, y, z, w], translation: this.#translation.toArray() };
  }

  /** The centre of A's box after the move. */
  get middle(): Vector3 {
    return this.#middle.clone().add(this.move);
  }

  /** The pose as a matrix, for a mesh relative to `origin` in a scene relative to `center`. */
  matrix(origin: Vector3, center: Vector3): Matrix4 {
    const position = origin
      .clone()
      .applyQuaternion(this.rotation)
      .add(this.#translation)
      .sub(center);
    return new Matrix4().compose(position, this.rotation, new Vector3(1, 1, 1));
  }
}

/** Returns the angles about x, y and z, in degrees, that make the pose's rotation. */
export function degreesOf(rotation: Quaternion): Vector3 {
  const { x, y, z } = new Euler().setFromQuaternion(rotation, ORDER);
  return new Vector3(x, y, z).multiplyScalar(MathUtils.RAD2DEG);
}
