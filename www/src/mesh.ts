// One model in the scene: its surface, its outline, its triangles.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
} from "three";
import { glass, satin } from "./material.ts";
import type { Shown } from "./protocol.ts";

const TRIANGLES = { color: 0x101820, wireframe: true, transparent: true, opacity: 0.16 };

export class ModelMesh {
  readonly group = new Group();
  readonly shown: Shown;
  readonly #satin: Material;
  readonly #glass: Material;
  readonly #surface: Mesh;
  readonly #triangles: Mesh;
  readonly #outline: LineSegments;

  constructor(shown: Shown, color: string) {
    this.shown = shown;
    const { positions, normals, indices } = shown.tessellation;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    const edges = new BufferGeometry();
    edges.setAttribute("position", geometry.getAttribute("position"));
    edges.setIndex(new BufferAttribute(shown.outline, 1));
    this.#satin = satin(color);
    this.#glass = glass(color);
    this.#surface = new Mesh(geometry, this.#satin);
    this.#outline = new LineSegments(
      edges,
      new LineBasicMaterial({ color: 0x0d151d, transparent: true, opacity: 0.55 }),
    );
    // Its lines are made from the triangles when it is first drawn.
    this.#triangles = new Mesh(geometry, new MeshBasicMaterial(TRIANGLES));
    this.#triangles.visible = false;
    this.group.add(this.#surface, this.#outline, this.#triangles);
    this.group.matrixAutoUpdate = false;
  }

  set transparent(transparent: boolean) {
    this.#surface.material = transparent ? this.#glass : this.#satin;
    this.#surface.renderOrder = transparent ? 1 : 0;
  }

  set triangles(visible: boolean) {
    this.#triangles.visible = visible;
  }

  dispose(): void {
    this.group.removeFromParent();
    for (const part of [this.#surface, this.#outline, this.#triangles]) part.geometry.dispose();
    const { material: lines } = this.#outline;
    const { material: triangles } = this.#triangles;
    for (const material of [this.#satin, this.#glass, lines, triangles].flat()) material.dispose();
  }
}
