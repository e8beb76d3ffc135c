// One model in the scene: its surface, plain or painted, its outline and its triangles.
import type { Vector3 as Point } from "nurbs-hausdorff";
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
  type Plane,
  type Texture,
  Vector3,
} from "three";
import type { DisplayModel } from "../worker/protocol.ts";
import { type FaceClass, FaceColors } from "./faces.ts";
import { glass, painted, satin } from "./material.ts";

/** How much of a model is shown: all, a see-through surface, or nothing. */
export type Visibility = "solid" | "glass" | "hidden";

const TRIANGLES = { color: 0x101820, wireframe: true, transparent: true, opacity: 0.16 };

export class ModelMesh {
  readonly group = new Group();
  readonly model: DisplayModel;
  readonly #satin: Material;
  readonly #glass: Material;
  readonly #surface: Mesh;
  readonly #painted: Mesh;
  readonly #triangles: Mesh;
  readonly #outline: LineSegments;
  readonly #faces: FaceColors;
  #hasPaint = false;

  /** `map` is the colour scale of the paint. */
  constructor(model: DisplayModel, color: string, map: Texture) {
    this.model = model;
    this.#painted = new Mesh(new BufferGeometry(), painted(map));
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
    this.#faces = new FaceColors(geometry, model.tessellation.faces, color);
    this.group.add(
      ...[this.#surface, this.#painted, this.#faces.mesh],
      ...[this.#outline, this.#triangles],
    );
    this.group.matrixAutoUpdate = false;
  }

  set visibility(visibility: Visibility) {
    const transparent = visibility === "glass";
    this.group.visible = visibility !== "hidden";
    this.#surface.material = transparent ? this.#glass : this.#satin;
    this.#surface.renderOrder = transparent ? 1 : 0;
  }

  /** The planes that cut the model open. */
  set clipping(planes: Plane[]) {
    for (const material of this.#materials()) material.clippingPlanes = planes;
  }

  /** The mesh that the pointer can hit, in the model's coordinates relative to its origin. */
  get target(): Mesh {
    return this.#surface;
  }

  /** What an export contains: the painted surface if there is paint. */
  get exported(): Mesh {
    return this.#hasPaint ? this.#painted : this.#surface;
  }

  set triangles(visible: boolean) {
    this.#triangles.visible = visible;
  }

  /** Shows coloured triangles instead of the surface; without a geometry, the surface. */
  paint(geometry?: BufferGeometry, origin: Point = [0, 0, 0]): void {
    this.#painted.geometry.dispose();
    if (geometry !== undefined) this.#painted.geometry = geometry;
    this.#painted.position.set(...origin).sub(new Vector3(...this.model.tessellation.origin));
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
    for (const material of this.#materials()) material.dispose();
  }

  #materials(): Material[] {
    const { material } = this.#faces.mesh;
    const parts = [this.#painted, this.#outline, this.#triangles];
    return [this.#satin, this.#glass, ...material, ...parts.flatMap((part) => part.material)];
  }
}
