// Line segments from the vertices of a map to their closest points, coloured by the deviation.
import {
  BufferAttribute,
  BufferGeometry,
  LineBasicMaterial,
  LineSegments,
  type Texture,
  type Vector3,
} from "three";
import type { MapDisplay } from "../../worker/map/display.ts";

export class ProjectionLines {
  readonly lines: LineSegments;

  /** `map` is the colour scale. */
  constructor(map: Texture) {
    this.lines = new LineSegments(
      new BufferGeometry(),
      new LineBasicMaterial({ map, transparent: true, opacity: 0.9 }),
    );
    this.lines.renderOrder = 3;
    this.lines.frustumCulled = false;
    this.hide();
  }

  hide(): void {
    this.lines.visible = false;
  }

  /** Draws the lines of a map. `center` is the scene's origin. */
  show(map: MapDisplay, center: Vector3): void {
    this.lines.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(map.lines, 3));
    // Both ends of a line have the deviation of the vertex that it starts from.
    const coordinates = Float32Array.from({ length: 4 * map.lineVertices.length }, (_, index) => {
      const vertex = map.lineVertices[index >> 2] ?? 0;
      return map.coordinates[2 * vertex + (index & 1)] ?? 0;
    });
    geometry.setAttribute("uv", new BufferAttribute(coordinates, 2));
    this.lines.geometry = geometry;
    this.lines.position.set(...map.lineOrigin).sub(center);
    this.lines.visible = true;
  }
}
