// Line segments from the samples of A to their closest points, coloured by the signed deviation.
import type { Field } from "nurbs-hausdorff";
import {
  BufferAttribute,
  BufferGeometry,
  LineBasicMaterial,
  LineSegments,
  type Vector3,
} from "three";
import { deviationColor } from "../colors.ts";

/** The largest number of lines drawn; more would hide the models. */
const MAX_LINES = 4096;

export class ProjectionLines {
  readonly lines = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.9 }),
  );

  constructor() {
    this.lines.renderOrder = 3;
    this.lines.frustumCulled = false;
    this.hide();
  }

  hide(): void {
    this.lines.visible = false;
  }

  /** Draws the lines of the fields. `center` is the scene's origin; the colour scale ends at `largest`. */
  show(fields: Field[], largest: number, center: Vector3): void {
    const positions: number[] = [];
    const colors: number[] = [];
    const middle = center.toArray();
    const step = stepOf(fields);
    for (const { points, feet, signed, counts } of fields) {
      for (const index of thinned(counts, step)) {
        const color = deviationColor(largest > 0 ? (signed[index] ?? 0) / largest : 0);
        for (const ends of [points, feet]) {
          for (let axis = 0; axis < 3; axis++) {
            positions.push((ends[3 * index + axis] ?? 0) - (middle[axis] ?? 0));
          }
          colors.push(color.r, color.g, color.b);
        }
      }
    }
    this.lines.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(colors), 3));
    this.lines.geometry = geometry;
    this.lines.visible = true;
  }
}

/** Returns the step between the rows, and between the columns, of the samples drawn. */
function stepOf(fields: Field[]): number {
  const count = fields.reduce((sum, { distances }) => sum + distances.length, 0);
  return Math.max(1, Math.ceil(Math.sqrt(count / MAX_LINES)));
}

/** Yields the indices of the samples on every `step`-th row and column. */
function* thinned([rows, columns]: [number, number], step: number): Generator<number> {
  for (let row = 0; row < rows; row += step) {
    for (let column = 0; column < columns; column += step) yield row * columns + column;
  }
}
