// One model in the scene: its surface, plain or painted, its outline and its triangles.
import {
  type Box3,
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
} from "three";
import type { DisplayModel } from "../worker/protocol.ts";
import { type FaceClass, FaceColors } from "./faces.ts";
import { glass, painted, satin } from "./material.ts";

const TRIANGLES = { color: 0x101820, wireframe: true, transparent: true, opacity: 0.16 };

export class ModelMesh {
  readonly group = new Group();
  readonly model: DisplayModel;
  readonly #satin: Material;
  readonly #glass: Material;
  readonly #surface: Mesh;
  readonly #painted = new Mesh(new BufferGeometry(), painted());
  readonly #triangles: Mesh;
  readonly #outline: LineSegments;
  readonly #faces: FaceColors;
  #hasPaint = false;

  constructor(model: DisplayModel, color: string) {
    this.model = model;
    const { positions, normals, indices } = model.tessellation;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    const edges = new BufferGeometry();
    edges.setAttribute("position", geometry.getAttribute("position"));
    edges.setIndex(new BufferAttribute(model.outline, 1));
    this.#satin = satin(color);
    this.#glass = glass(color);
    this.#surface = new Mesh(geometry, this.#satin);
    this.#outline = new LineSegments(
      edges,
      new LineBasicMaterial({ color: 0x0d151d, transparent: true, opacity: 0.55 }),
    );
    this.#outline.renderOrder = 3;
    // Three.js derives the lines from the triangles at the first drawing.
    this.#triangles = new Mesh(geometry, new MeshBasicMaterial(TRIANGLES));
    this.#triangles.visible = false;
    this.#triangles.renderOrder = 3;
    this.#painted.visible = false;
    this.#painted.renderOrder = 2;
    this.#faces = new FaceColors(geometry, model.tessellation.surfaces, color);
    this.group.add(
      ...[this.#surface, this.#painted, this.#faces.mesh],
      ...[this.#outline, this.#triangles],
    );
    this.group.matrixAutoUpdate = false;
  }

  set transparent(transparent: boolean) {
    this.#surface.material = transparent ? this.#glass : this.#satin;
    this.#surface.renderOrder = transparent ? 1 : 0;
  }

  set triangles(visible: boolean) {
    this.#triangles.visible = visible;
  }

  /** Shows coloured triangles, relative to the same origin, instead of the surface; without a geometry, the surface. */
  paint(geometry: BufferGeometry | undefined): void {
    this.#painted.geometry.dispose();
    if (geometry !== undefined) this.#painted.geometry = geometry;
    this.#hasPaint = geometry !== undefined;
    this.#showSurface();
  }

  /** Colours every face by its class, instead of all paint; without classes, ends that. */
  classify(classes: FaceClass[] | undefined): void {
    this.#faces.show(classes);
    this.#showSurface();
  }

  /** The box of one face, in scene coordinates. */
  faceBox(face: number): Box3 {
    return this.#faces.box(face).applyMatrix4(this.group.matrix);
  }

  #showSurface(): void {
    const plain = !this.#faces.mesh.visible;
    this.#painted.visible = plain && this.#hasPaint;
    this.#surface.visible = plain && !this.#hasPaint;
  }

  dispose(): void {
    this.group.removeFromParent();
    this.#faces.dispose();
    const parts = [this.#surface, this.#painted, this.#outline, this.#triangles];
    for (const part of parts) part.geometry.dispose();
    const materials = [this.#satin, this.#glass, ...parts.slice(1).map(({ material }) => material)];
    for (const material of materials.flat()) material.dispose();
  }
}
