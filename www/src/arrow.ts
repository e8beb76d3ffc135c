// The arrow between the two witness points, as in the paper's Fig. 1.
import type { DistanceResult } from "nurbs-hausdorff";
import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  type PerspectiveCamera,
  SphereGeometry,
  Vector3,
} from "three";
import { distanceText } from "./numbers.ts";

/** Radii in pixels, whatever the zoom, so that short arrows are seen and long ones slim. */
const SHAFT = 2.2;
const HEAD = 7.5;
const START = 5;
const END = 2.6;
/** Length of the head in its radii. */
const SLIMNESS = 2.6;
/** The head is at most this part of the arrow. */
const MOST_HEAD = 0.5;
const UP = new Vector3(0, 1, 0);

export class Arrow {
  readonly group = new Group();
  readonly #from = new Vector3();
  readonly #to = new Vector3();
  readonly #middle = new Vector3();
  readonly #label: HTMLElement;
  readonly #shaft: Mesh;
  readonly #head: Mesh;
  readonly #start: Mesh;
  readonly #end: Mesh;

  constructor(label: HTMLElement, color: string) {
    this.#label = label;
    // Not covered by what lies before it; drawn last, with the transparent.
    const material = new MeshBasicMaterial({
      color,
      depthTest: false,
      transparent: true,
      toneMapped: false,
    });
    this.#shaft = new Mesh(new CylinderGeometry(1, 1, 1, 16), material);
    this.#head = new Mesh(new ConeGeometry(1, SLIMNESS, 24), material);
    const ball = new SphereGeometry(1, 24, 16);
    this.#start = new Mesh(ball, material);
    this.#end = new Mesh(ball, material);
    this.group.add(this.#shaft, this.#head, this.#start, this.#end);
    for (const part of this.group.children) part.renderOrder = 4;
    this.hide();
  }

  hide(): void {
    this.group.visible = false;
    this.#label.hidden = true;
  }

  /** From the witness on A to the one on B, in a scene around `center`. */
  show({ witness, computed, diagonal }: DistanceResult, center: Vector3): void {
    this.#from.set(...witness.a.point).sub(center);
    this.#to.set(...witness.b.point).sub(center);
    this.#middle.copy(this.#from).lerp(this.#to, 0.5);
    this.#label.textContent = distanceText(computed, diagonal);
    this.group.visible = true;
  }

  /** The arrow's middle in the scene. */
  get middle(): Vector3 {
    return this.#middle;
  }

  get length(): number {
    return this.#from.distanceTo(this.#to);
  }

  /** Sizes the arrow for the camera, and puts the label where its middle is seen. */
  place(camera: PerspectiveCamera, width: number, height: number): void {
    if (!this.group.visible) return;
    const seen = this.#middle.clone().project(camera);
    this.#label.hidden = Math.abs(seen.z) > 1;
    this.#label.style.left = `${(0.5 + 0.5 * seen.x) * width}px`;
    this.#label.style.top = `${(0.5 - 0.5 * seen.y) * height}px`;
    const away = camera.position.distanceTo(this.#middle);
    this.#size((2 * away * Math.tan((camera.fov * Math.PI) / 360)) / height);
  }

  #size(pixel: number): void {
    const { length } = this;
    const direction = this.#to.clone().sub(this.#from).normalize();
    const head = Math.min(HEAD * pixel, (MOST_HEAD * length) / SLIMNESS);
    const shaft = length - SLIMNESS * head;
    for (const part of [this.#shaft, this.#head]) {
      part.visible = length > 0;
      part.quaternion.setFromUnitVectors(UP, direction);
    }
    const radius = Math.min(SHAFT * pixel, head / 2);
    this.#shaft.scale.set(radius, shaft, radius);
    this.#shaft.position.copy(this.#from).addScaledVector(direction, shaft / 2);
    this.#head.scale.setScalar(head);
    this.#head.position.copy(this.#to).addScaledVector(direction, (-SLIMNESS * head) / 2);
    this.#start.position.copy(this.#from);
    this.#start.scale.setScalar(START * pixel);
    this.#end.position.copy(this.#to);
    this.#end.scale.setScalar(END * pixel);
  }
}
