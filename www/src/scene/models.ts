// The two models in the scene.
import type { Field, Transform } from "nurbs-hausdorff";
import { Box3, Group, Vector3 } from "three";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";
import type { FaceClass } from "./faces.ts";
import { ModelMesh } from "./mesh.ts";
import { deviationGeometry } from "./overlays/deviation.ts";
import type { Pose } from "./pose.ts";

export class Models {
  readonly group = new Group();
  /**
   * The scene's origin in the coordinates of the models. The GPU draws in
   * float32, which is too coarse for models far from their origin.
   */
  readonly center = new Vector3();
  readonly #colors: Record<Side, string>;
  readonly #meshes: Sides<ModelMesh> = {};

  constructor(colors: Record<Side, string>) {
    this.#colors = colors;
  }

  /** Adds models to the scene, each in place of the one before. */
  show(models: Sides<DisplayModel>): void {
    for (const side of SIDES) {
      const model = models[side];
      if (model === undefined) continue;
      this.#meshes[side]?.dispose();
      const mesh = new ModelMesh(model, this.#colors[side]);
      this.#meshes[side] = mesh;
      this.group.add(mesh.group);
    }
    const box = (this.#meshes.b ?? this.#meshes.a)?.model.box;
    if (box !== undefined) boxOf(box).getCenter(this.center);
  }

  /** B is always transparent, as A may lie inside it; A only on request. */
  setDisplay(transparent: boolean, triangles: boolean): void {
    const { a, b } = this.#meshes;
    if (a) a.transparent = transparent;
    if (b) b.transparent = true;
    for (const mesh of Object.values(this.#meshes)) mesh.triangles = triangles;
  }

  /** Paints A by its deviation, measured at `transform`, on a scale that ends at `largest`. */
  paint(fields: Field[], largest: number, transform: Transform): void {
    const { a } = this.#meshes;
    if (a === undefined) return;
    const origin = new Vector3(...a.model.tessellation.origin);
    a.paint(deviationGeometry(fields, largest, transform, origin));
  }

  /** Colours the faces of both models by their classes; without classes, as models. */
  classify(classes: Sides<FaceClass[]>): void {
    for (const side of SIDES) this.#meshes[side]?.classify(classes[side]);
  }

  /** The box of one face, in scene coordinates. */
  faceBox(side: Side, face: number): Box3 {
    return this.#meshes[side]?.faceBox(face) ?? new Box3();
  }

  /** Removes the paint from A. */
  clearPaint(): void {
    this.#meshes.a?.paint(undefined);
  }

  /** Whether both models are loaded. */
  get complete(): boolean {
    return SIDES.every((side) => this.#meshes[side] !== undefined);
  }

  /** The larger diagonal of the two models' boxes. */
  get diagonal(): number {
    const diagonals = Object.values(this.#meshes).map(({ model: { box } }) =>
      new Vector3(...box.min).distanceTo(new Vector3(...box.max)),
    );
    return Math.max(...diagonals, 0);
  }

  /** The centre of A's box before A is moved. */
  get middle(): Vector3 {
    const box = this.#meshes.a?.model.box;
    return box === undefined ? new Vector3() : boxOf(box).getCenter(new Vector3());
  }

  /** The box of both models at their positions, in scene coordinates. */
  get box(): Box3 {
    return new Box3().setFromObject(this.group);
  }

  /** Moves A to the pose, and B to its own position. */
  pose(pose: Pose): void {
    for (const side of SIDES) {
      const mesh = this.#meshes[side];
      if (mesh === undefined) continue;
      const origin = new Vector3(...mesh.model.tessellation.origin);
      if (side === "a") mesh.group.matrix.copy(pose.matrix(origin, this.center));
      else mesh.group.matrix.setPosition(origin.sub(this.center));
      mesh.group.matrixWorldNeedsUpdate = true;
    }
  }
}

function boxOf({ min, max }: DisplayModel["box"]): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max));
}
