// Handles in the view that move and turn A.
import { Object3D, type Quaternion, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Viewport } from "./camera/viewport.ts";
import type { Pose } from "./pose.ts";

export type GizmoMode = "none" | "translate" | "rotate";

/** Receives the translation of A and its rotation. */
export type OnGizmo = (move: Vector3, rotation: Quaternion) => void;

export class Gizmo {
  readonly #viewport: Viewport;
  readonly #proxy = new Object3D();
  readonly #controls: TransformControls;
  /** The point of the scene at which the handles are without a translation. */
  readonly #rest = new Vector3();

  constructor(viewport: Viewport, canvas: HTMLCanvasElement, onMove: OnGizmo) {
    this.#viewport = viewport;
    this.#controls = new TransformControls(viewport.camera, canvas);
    viewport.scene.add(this.#proxy, this.#controls.getHelper());
    this.#controls.addEventListener("dragging-changed", ({ value }) => {
      viewport.controls.enabled = value !== true;
    });
    this.#controls.addEventListener("change", () => viewport.draw());
    this.#controls.addEventListener("objectChange", () => {
      onMove(this.#proxy.position.clone().sub(this.#rest), this.#proxy.quaternion.clone());
    });
  }

  set mode(mode: GizmoMode) {
    if (mode === "none") this.#controls.detach();
    else {
      this.#controls.setMode(mode);
      this.#controls.attach(this.#proxy);
    }
    this.#viewport.draw();
  }

  /** Calls `work` while the handles are hidden. */
  without(work: () => void): void {
    const handles = this.#controls.getHelper();
    const { visible } = handles;
    handles.visible = false;
    work();
    handles.visible = visible;
  }

  /** Whether a handle is held. */
  get dragging(): boolean {
    return this.#controls.dragging;
  }

  /** Puts the handles at A; `center` is the scene's origin. */
  place(pose: Pose, center: Vector3): void {
    this.#controls.camera = this.#viewport.camera;
    this.#rest.copy(pose.middle).sub(pose.move).sub(center);
    if (this.dragging) return;
    this.#proxy.position.copy(this.#rest).add(pose.move);
    this.#proxy.quaternion.copy(pose.rotation);
  }
}
