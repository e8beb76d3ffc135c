// Where model A stands.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import { Matrix4, Quaternion, Vector3 as Vector } from "three";

/** A turned about its own middle's vertical axis, then moved. */
export class Pose {
  readonly rotation: Quaternion;
  readonly translation: Vector;

  constructor(degrees: number, move: Vector3, middle: Vector3) {
    this.rotation = new Quaternion().setFromAxisAngle(
      new Vector(0, 0, 1),
      (degrees * Math.PI) / 180,
    );
    const center = new Vector(...middle);
    this.translation = center
      .clone()
      .sub(center.clone().applyQuaternion(this.rotation))
      .add(new Vector(...move));
  }

  /** As the package takes it. */
  get transform(): Transform {
    const { x, y, z, w } = this.rotation;
    return { rotation: [x, y, z, w], translation: this.translation.toArray() };
  }

  /** As the scene takes it, for a mesh around `origin` in a scene around `center`. */
  matrix(origin: Vector, center: Vector): Matrix4 {
    const position = origin
      .clone()
      .applyQuaternion(this.rotation)
      .add(this.translation)
      .sub(center);
    return new Matrix4().compose(position, this.rotation, new Vector(1, 1, 1));
  }
}
