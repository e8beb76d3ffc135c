// A model while its file is read: the edges of its faces, and the faces that are cut already.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  Vector3,
} from "three";
import type { Draft } from "../worker/protocol.ts";
import { satin } from "./material.ts";

export class DraftModel {
  readonly group = new Group();
  readonly #surface: Material;
  readonly #line: Material;
  readonly #geometries: BufferGeometry[] = [];

  constructor(color: string) {
    this.#surface = satin(color);
    this.#line = new LineBasicMaterial({ color });
  }

  /** Adds faces, where the scene's origin is this point of the models. */
  add({ origin, edges, positions, normals, indices }: Draft, center: Vector3, scale: number): void {
    const place = new Vector3(...origin).multiplyScalar(scale).sub(center);
    const parts: (Mesh | LineSegments)[] = [];
    if (edges.length > 0) {
      parts.push(new LineSegments(this.#geometry({ position: edges }), this.#line));
    }
    if (indices.length > 0) {
      const geometry = this.#geometry({ position: positions, normal: normals });
      geometry.setIndex(new BufferAttribute(indices, 1));
      parts.push(new Mesh(geometry, this.#surface));
    }
    for (const part of parts) {
      part.position.copy(place);
      part.scale.setScalar(scale);
      this.group.add(part);
    }
  }

  get box(): Box3 {
    return new Box3().setFromObject(this.group);
  }

  dispose(): void {
    this.group.removeFromParent();
    for (const part of [this.#surface, this.#line, ...this.#geometries]) part.dispose();
  }

  #geometry(attributes: Record<string, Float32Array>): BufferGeometry {
    const geometry = new BufferGeometry();
    for (const [name, values] of Object.entries(attributes)) {
      geometry.setAttribute(name, new BufferAttribute(values, 3));
    }
    this.#geometries.push(geometry);
    return geometry;
  }
}
