// The two models as shaded meshes.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshPhysicalMaterial,
  Vector3,
  WireframeGeometry,
} from "three";
import type { Pose } from "./pose.ts";
import type { Shown, Side } from "./protocol.ts";

const COLORS: Record<Side, number> = { a: 0x2f7fc1, b: 0xe09a35 };
/** B is seen through, as A may lie inside. */
const OPACITY: Record<Side, number> = { a: 1, b: 0.42 };

export class Models {
  readonly group = new Group();
  /** The point that the scene is around, in the models' coordinates. */
  readonly center = new Vector3();
  readonly #shown: Partial<Record<Side, Shown>> = {};
  readonly #meshes: Partial<Record<Side, Mesh>> = {};
  readonly #edges: Partial<Record<Side, LineSegments>> = {};
  #edgesVisible = false;

  show(side: Side, shown: Shown): void {
    const { positions, normals, indices } = shown.tessellation;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    const material = new MeshPhysicalMaterial({
      color: COLORS[side],
      roughness: 0.42,
      metalness: 0.05,
      clearcoat: 0.35,
      clearcoatRoughness: 0.4,
      side: DoubleSide,
      transparent: OPACITY[side] < 1,
      opacity: OPACITY[side],
      depthWrite: OPACITY[side] === 1,
    });
    this.#remove(side);
    const mesh = new Mesh(geometry, material);
    mesh.renderOrder = side === "a" ? 0 : 1;
    const edges = new LineSegments(
      new WireframeGeometry(geometry),
      new LineBasicMaterial({ color: 0x101820, transparent: true, opacity: 0.22 }),
    );
    edges.visible = this.#edgesVisible;
    mesh.add(edges);
    mesh.matrixAutoUpdate = false;
    this.#meshes[side] = mesh;
    this.#edges[side] = edges;
    this.#shown[side] = shown;
    this.group.add(mesh);
    const b = this.#shown.b ?? shown;
    this.center
      .fromArray(b.box.min)
      .add(new Vector3(...b.box.max))
      .multiplyScalar(0.5);
  }

  set edges(visible: boolean) {
    this.#edgesVisible = visible;
    for (const edges of Object.values(this.#edges)) edges.visible = visible;
  }

  get complete(): boolean {
    return this.#shown.a !== undefined && this.#shown.b !== undefined;
  }

  /** The larger of the two boxes' diagonals. */
  get diagonal(): number {
    const diagonal = ({ box }: Shown) =>
      new Vector3(...box.min).distanceTo(new Vector3(...box.max));
    return Math.max(...Object.values(this.#shown).map(diagonal), 0);
  }

  /** The middle of A's box. */
  get middle(): [number, number, number] {
    const box = this.#shown.a?.box;
    if (box === undefined) return [0, 0, 0];
    const at = (axis: 0 | 1 | 2) => 0.5 * (box.min[axis] + box.max[axis]);
    return [at(0), at(1), at(2)];
  }

  /** Puts A where the pose says, B where it is. */
  pose(pose: Pose): void {
    for (const side of ["a", "b"] as const) {
      const [mesh, shown] = [this.#meshes[side], this.#shown[side]];
      if (mesh === undefined || shown === undefined) continue;
      const origin = new Vector3(...shown.tessellation.origin);
      if (side === "a") mesh.matrix.copy(pose.matrix(origin, this.center));
      else mesh.matrix.setPosition(origin.sub(this.center));
      mesh.matrixWorldNeedsUpdate = true;
    }
  }

  #remove(side: Side): void {
    const mesh = this.#meshes[side];
    if (mesh === undefined) return;
    this.group.remove(mesh);
    mesh.geometry.dispose();
    (mesh.material as MeshPhysicalMaterial).dispose();
    this.#edges[side]?.geometry.dispose();
  }
}
