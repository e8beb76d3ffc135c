// The arrow between the two witness points, as in the paper's Fig. 1.
import type { DistanceResult } from "nurbs-hausdorff";
import {
  type Camera,
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { distanceText } from "./numbers.ts";

/** Sizes as parts of the diagonal. */
const SHAFT = 0.0035;
const HEAD = 0.012;
const POINT = 0.008;
const UP = new Vector3(0, 1, 0);

export class Arrow {
  readonly group = new Group();
  readonly #material = new MeshBasicMaterial({
    color: 0xc8324b,
    depthTest: false,
    // Transparent parts are drawn last, so this is not covered by B.
    transparent: true,
  });
  readonly #shaft = new Mesh(new CylinderGeometry(1, 1, 1, 16), this.#material);
  readonly #head = new Mesh(new ConeGeometry(1, 2.4, 24), this.#material);
  readonly #points = [0, 1].map(() => new Mesh(new SphereGeometry(1, 24, 16), this.#material));
  readonly #label: HTMLElement;
  readonly #middle = new Vector3();

  constructor(label: HTMLElement) {
    this.#label = label;
    this.group.add(this.#shaft, this.#head, ...this.#points);
    for (const part of this.group.children) part.renderOrder = 3;
    this.hide();
  }

  hide(): void {
    this.group.visible = false;
    this.#label.hidden = true;
  }

  show(result: DistanceResult, center: Vector3): void {
    const a = new Vector3(...result.witness.a.point).sub(center);
    const b = new Vector3(...result.witness.b.point).sub(center);
    const { diagonal } = result;
    const length = a.distanceTo(b);
    const direction = b.clone().sub(a).normalize();
    const head = Math.min(HEAD * diagonal, length / 3);
    const shaft = Math.max(length - 2.4 * head, 0);
    for (const part of [this.#shaft, this.#head]) {
      part.quaternion.setFromUnitVectors(UP, direction);
      part.visible = length > 0;
    }
    this.#shaft.scale.set(SHAFT * diagonal, Math.max(shaft, Number.MIN_VALUE), SHAFT * diagonal);
    this.#shaft.position.copy(a).addScaledVector(direction, shaft / 2);
    this.#head.scale.setScalar(head);
    this.#head.position.copy(b).addScaledVector(direction, -1.2 * head);
    this.#points.forEach((point, index) => {
      point.position.copy(index === 0 ? a : b);
      point.scale.setScalar((index === 0 ? POINT : POINT / 2) * diagonal);
    });
    this.#middle.copy(a).add(b).multiplyScalar(0.5);
    this.#label.textContent = distanceText(result.computed, result.diagonal);
    this.group.visible = true;
  }

  /** Puts the label where the arrow's middle is seen. */
  place(camera: Camera, width: number, height: number): void {
    const seen = this.#middle.clone().project(camera);
    this.#label.hidden = !this.group.visible || Math.abs(seen.z) > 1;
    this.#label.style.left = `${(0.5 + 0.5 * seen.x) * width}px`;
    this.#label.style.top = `${(0.5 - 0.5 * seen.y) * height}px`;
  }
}
