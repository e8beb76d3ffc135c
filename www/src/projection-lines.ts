// Lines from samples to their feet, coloured by length, as in the paper's Fig. 2.
import type { Field } from "nurbs-hausdorff";
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  LineBasicMaterial,
  LineSegments,
  type Vector3,
} from "three";

/** Lines drawn, at most; more would hide the models. */
const MOST_LINES = 3000;

const NEAR = new Color(0x2a9d6f);
const FAR = new Color(0xc8324b);

export class ProjectionLines {
  readonly lines = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.75 }),
  );

  constructor() {
    this.lines.renderOrder = 2;
    this.lines.frustumCulled = false;
  }

  hide(): void {
    this.lines.visible = false;
  }

  show(fields: Field[], center: Vector3): void {
    const count = fields.reduce((sum, field) => sum + field.distances.length, 0);
    const stride = Math.max(1, Math.ceil(count / MOST_LINES));
    const largest = fields.reduce(
      (most, field) => field.distances.reduce((a, b) => Math.max(a, b), most),
      0,
    );
    const positions: number[] = [];
    const colors: number[] = [];
    const middle = center.toArray();
    for (const { points, feet, distances } of fields) {
      for (let index = 0; index < distances.length; index += stride) {
        const color = NEAR.clone().lerp(FAR, largest > 0 ? (distances[index] ?? 0) / largest : 0);
        for (const ends of [points, feet]) {
          for (let axis = 0; axis < 3; axis++) {
            positions.push((ends[3 * index + axis] ?? 0) - (middle[axis] ?? 0));
          }
          colors.push(color.r, color.g, color.b);
        }
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute(
      "position",
      new BufferAttribute(new Float32Array(positions), 3),
    );
    this.lines.geometry.setAttribute("color", new BufferAttribute(new Float32Array(colors), 3));
    this.lines.visible = true;
  }
}
