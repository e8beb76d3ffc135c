// The face of a cut through a closed model: counted in the stencil buffer, drawn as a plane.
//
// It is where the number of faces in front is odd, which is what inside means for signs and sides too:
// faces may be oriented either way.
import {
  AlwaysStencilFunc,
  type BufferGeometry,
  DoubleSide,
  Group,
  InvertStencilOp,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  NotEqualStencilFunc,
  type Plane,
  PlaneGeometry,
  ReplaceStencilOp,
  Vector3,
} from "three";
import type { Side } from "../worker/protocol.ts";

/** The order in which caps are drawn: after opaque surfaces, one model after the other. */
const ORDERS = { a: 0.1, b: 0.3 } as const;
/** How much darker a cap is than its model. */
const DARKENED = 0.72;

export class Cap {
  /** What is counted: moves with the model. */
  readonly group = new Group();
  /** The plane, which is placed in the scene. */
  readonly plane: Mesh;
  readonly #counted: MeshBasicMaterial;

  constructor(geometry: BufferGeometry, side: Side, color: string) {
    const order = ORDERS[side];
    this.#counted = new MeshBasicMaterial({
      ...{ side: DoubleSide, colorWrite: false, depthWrite: false, depthTest: false },
      ...{ stencilWrite: true, stencilFunc: AlwaysStencilFunc, stencilZPass: InvertStencilOp },
    });
    const counted = new Mesh(geometry, this.#counted);
    counted.renderOrder = order;
    this.group.add(counted);
    const material = new MeshStandardMaterial({
      ...{ color, roughness: 0.9, side: 2 },
      ...{ stencilWrite: true, stencilRef: 0, stencilFunc: NotEqualStencilFunc },
      ...{
        stencilFail: ReplaceStencilOp,
        stencilZFail: ReplaceStencilOp,
        stencilZPass: ReplaceStencilOp,
      },
    });
    material.color.multiplyScalar(DARKENED);
    this.plane = new Mesh(new PlaneGeometry(1, 1), material);
    this.plane.renderOrder = order + 0.1;
    this.plane.onAfterRender = (renderer) => renderer.clearStencil();
    this.cut(undefined);
  }

  /** Shows the cut at a plane of the scene; without one, none. */
  cut(plane: Plane | undefined): void {
    this.group.visible = plane !== undefined;
    this.plane.visible = plane !== undefined;
    if (plane === undefined) return;
    this.#counted.clippingPlanes = [plane];
    plane.coplanarPoint(this.plane.position);
    this.plane.lookAt(this.plane.position.clone().sub(plane.normal));
  }

  /** Makes the plane as large as the models. */
  set size(size: number) {
    this.plane.scale.copy(new Vector3(size, size, 1));
  }

  dispose(): void {
    this.plane.removeFromParent();
    this.plane.geometry.dispose();
    (this.plane.material as MeshStandardMaterial).dispose();
    this.#counted.dispose();
  }
}
