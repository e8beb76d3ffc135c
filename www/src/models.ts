// The two models in the scene.
import type { Field, Transform } from "nurbs-hausdorff";
import { Box3, Group, Vector3 } from "three";
import { deviationGeometry } from "./deviation.ts";
import { ModelMesh } from "./mesh.ts";
import type { Pose } from "./pose.ts";
import { type Shown, SIDES, type Side, type Sides } from "./protocol.ts";

export class Models {
  readonly group = new Group();
  /**
   * The middle of the scene in the models' coordinates: float32, which the
   * GPU draws in, has no digits left for models far from the origin.
   */
  readonly center = new Vector3();
  readonly #colors: Record<Side, string>;
  readonly #meshes: Sides<ModelMesh> = {};

  constructor(colors: Record<Side, string>) {
    this.#colors = colors;
  }

  show(models: Sides<Shown>): void {
    for (const side of SIDES) {
      const shown = models[side];
      if (shown === undefined) continue;
      this.#meshes[side]?.dispose();
      const mesh = new ModelMesh(shown, this.#colors[side]);
      this.#meshes[side] = mesh;
      this.group.add(mesh.group);
    }
    const box = (this.#meshes.b ?? this.#meshes.a)?.shown.box;
    if (box !== undefined) boxOf(box).getCenter(this.center);
  }

  /** B is always seen through, as A may lie inside; A if what lies inside of it is to be seen. */
  look(transparent: boolean, triangles: boolean): void {
    const { a, b } = this.#meshes;
    if (a) a.transparent = transparent;
    if (b) b.transparent = true;
    for (const mesh of Object.values(this.#meshes)) mesh.triangles = triangles;
  }

  /** Paints A by its deviation as it was found in this place, in a scale to `largest`. */
  paint(fields: Field[], largest: number, transform: Transform): void {
    const { a } = this.#meshes;
    if (a === undefined) return;
    const origin = new Vector3(...a.shown.tessellation.origin);
    a.paint(deviationGeometry(fields, largest, transform, origin));
  }

  unpaint(): void {
    this.#meshes.a?.paint(undefined);
  }

  get complete(): boolean {
    return SIDES.every((side) => this.#meshes[side] !== undefined);
  }

  /** The larger of the two boxes' diagonals. */
  get diagonal(): number {
    const diagonals = Object.values(this.#meshes).map(({ shown: { box } }) =>
      new Vector3(...box.min).distanceTo(new Vector3(...box.max)),
    );
    return Math.max(...diagonals, 0);
  }

  /** The middle of A's box, before it is moved. */
  get middle(): Vector3 {
    const box = this.#meshes.a?.shown.box;
    return box === undefined ? new Vector3() : boxOf(box).getCenter(new Vector3());
  }

  /** Both models where they stand, in the scene's coordinates. */
  get box(): Box3 {
    return new Box3().setFromObject(this.group);
  }

  /** Puts A where the pose says, B where it is. */
  pose(pose: Pose): void {
    for (const side of SIDES) {
      const mesh = this.#meshes[side];
      if (mesh === undefined) continue;
      const origin = new Vector3(...mesh.shown.tessellation.origin);
      if (side === "a") mesh.group.matrix.copy(pose.matrix(origin, this.center));
      else mesh.group.matrix.setPosition(origin.sub(this.center));
      mesh.group.matrixWorldNeedsUpdate = true;
    }
  }
}

function boxOf({ min, max }: Shown["box"]): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max));
}
