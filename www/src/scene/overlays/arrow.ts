// The arrow from a point of one model to the closest point of the other.
import type { Vector3 as Point } from "nurbs-hausdorff";
import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { beginOf, type Part } from "../camera/free.ts";
import type { Viewport } from "../camera/viewport.ts";

/** Radii in pixels, independent of the zoom: short arrows stay visible and long ones slim. */
const SHAFT_RADIUS = 2.2;
const HEAD_RADIUS = 7.5;
const START_RADIUS = 5;
const END_RADIUS = 2.6;
/** The length of the head divided by its radius. */
const HEAD_ASPECT = 2.6;
/** The largest fraction of the arrow's length that the head takes. */
const MAX_HEAD_FRACTION = 0.5;
/** Pixels from the arrow to its label, as in the style sheet. */
const LEADER = 22;
/** Pixels from an end to the top of its label, as in the style sheet. */
const BELOW = 8;
/** Pixels from end to end above which both have labels of their own. */
const MIN_APART = 70;
/** Pixels between labels that would lie over each other. */
const APART = 3;
const UP = new Vector3(0, 1, 0);

/** What the arrow's labels say. */
export interface ArrowTexts {
  length: string;
  /** The faces at its ends. */
  from: string;
  to: string;
}

export class Arrow {
  readonly group = new Group();
  readonly #from = new Vector3();
  readonly #to = new Vector3();
  readonly #middle = new Vector3();
  readonly #label: HTMLElement;
  readonly #ends: readonly HTMLElement[];
  readonly #shaft: Mesh;
  readonly #head: Mesh;
  readonly #start: Mesh;
  readonly #end: Mesh;
  #shown: Parameters<Arrow["show"]> | undefined;

  /** `ends` are labels for the point that the arrow starts from and for the one that it points to, or none. */
  constructor(label: HTMLElement, ends: readonly HTMLElement[], color: string) {
    this.#label = label;
    this.#ends = ends;
    // Drawn last and without a depth test, so that the models never cover it.
    const material = new MeshBasicMaterial({
      color,
      depthTest: false,
      transparent: true,
      toneMapped: false,
    });
    this.#shaft = new Mesh(new CylinderGeometry(1, 1, 1, 16), material);
    this.#head = new Mesh(new ConeGeometry(1, HEAD_ASPECT, 24), material);
    const ball = new SphereGeometry(1, 24, 16);
    this.#start = new Mesh(ball, material);
    this.#end = new Mesh(ball, material);
    this.group.add(this.#shaft, this.#head, this.#start, this.#end);
    for (const part of this.group.children) part.renderOrder = 4;
    this.hide();
  }

  hide(): void {
    this.#shown = undefined;
    this.group.visible = false;
    for (const label of [this.#label, ...this.#ends]) label.hidden = true;
  }

  /** Shows the arrow between two points of the models. `center` is the origin of the scene. */
  show(from: Point, to: Point, texts: ArrowTexts, center: Vector3): void {
    this.#shown = [from, to, texts, center];
    this.#from.set(...from).sub(center);
    this.#to.set(...to).sub(center);
    this.#middle.copy(this.#from).lerp(this.#to, 0.5);
    this.#label.textContent = texts.length;
    for (const [index, label] of this.#ends.entries()) {
      label.textContent = index === 0 ? texts.from : texts.to;
    }
    this.group.visible = true;
  }

  /** What `show` was given last; undefined while nothing is shown. */
  get shown(): Parameters<Arrow["show"]> | undefined {
    return this.#shown;
  }

  /** The midpoint of the arrow, in scene coordinates. */
  get middle(): Vector3 {
    return this.#middle;
  }

  get length(): number {
    return this.#from.distanceTo(this.#to);
  }

  /** Adapts the arrow's thickness to the camera, and moves the labels to their points on the screen. */
  update(viewport: Viewport): void {
    if (!this.group.visible) return;
    const place = viewport.project(this.#middle);
    const ends = [viewport.project(this.#from), viewport.project(this.#to)] as const;
    const [from = [0, 0], to = [0, 0]] = ends;
    // Seen from far, both ends are at the label; seen head-on, it has their names.
    const isApart = Math.hypot(from[0] - to[0], from[1] - to[1]) >= MIN_APART;
    const pixel = viewport.pixelAt(this.#middle);
    const isHeadOn = !isApart && this.length >= MIN_APART * pixel;
    const names = this.#ends.flatMap(({ textContent }) => textContent || []);
    this.#label.dataset.ends = isHeadOn ? names.join(" → ") : "";
    this.#label.hidden = place === undefined;
    moveTo(this.#label, place);
    for (const [index, label] of this.#ends.entries()) {
      label.hidden = !isApart || ends[index] === undefined || label.textContent === "";
      moveTo(label, ends[index]);
    }
    this.#keepWithin(viewport.over, [place, ...ends]);
    this.#keepApart();
    this.#size(pixel);
  }

  /** Shifts labels that would reach over an edge of the view, or under what lies over its left half. */
  #keepWithin(
    over: readonly Part[],
    [middle, ...ends]: readonly (readonly [number, number] | undefined)[],
  ): void {
    const { clientWidth: width } = this.#label.parentElement ?? this.#label;
    // Left of the arrow where there is no room at its right.
    const reach = (middle?.[0] ?? 0) + LEADER + this.#label.offsetWidth;
    this.#label.classList.toggle("left", reach > width);
    for (const [index, label] of this.#ends.entries()) {
      // The middle of a label is at its end of the arrow, but for the shift.
      const [at, y] = ends[index] ?? [0, 0];
      const half = label.offsetWidth / 2;
      const begin = beginOf(over, [y, y + BELOW + label.offsetHeight], width);
      // What is covered itself keeps its label beside it.
      const free = at < begin ? 0 : begin;
      const shift = Math.max(free + half - at, Math.min(0, width - half - at));
      label.style.setProperty("--across", `${shift}px`);
    }
  }

  /** Moves the labels of ends below that of the length, where they would lie over it. */
  #keepApart(): void {
    for (const label of this.#ends) label.style.removeProperty("--down");
    if (this.#label.hidden) return;
    const own = this.#label.getBoundingClientRect();
    for (const label of this.#ends) {
      if (label.hidden) continue;
      const { left, right, top, bottom } = label.getBoundingClientRect();
      const isOver = left < own.right && right > own.left && top < own.bottom && bottom > own.top;
      if (isOver) label.style.setProperty("--down", `${own.bottom - top + APART}px`);
    }
  }

  #size(pixel: number): void {
    const { length } = this;
    const direction = this.#to.clone().sub(this.#from).normalize();
    const head = Math.min(HEAD_RADIUS * pixel, (MAX_HEAD_FRACTION * length) / HEAD_ASPECT);
    const shaft = length - HEAD_ASPECT * head;
    for (const part of [this.#shaft, this.#head]) {
      part.visible = length > 0;
      part.quaternion.setFromUnitVectors(UP, direction);
    }
    const radius = Math.min(SHAFT_RADIUS * pixel, head / 2);
    this.#shaft.scale.set(radius, shaft, radius);
    this.#shaft.position.copy(this.#from).addScaledVector(direction, shaft / 2);
    this.#head.scale.setScalar(head);
    this.#head.position.copy(this.#to).addScaledVector(direction, (-HEAD_ASPECT * head) / 2);
    this.#start.position.copy(this.#from);
    this.#start.scale.setScalar(START_RADIUS * pixel);
    this.#end.position.copy(this.#to);
    this.#end.scale.setScalar(END_RADIUS * pixel);
  }
}

function moveTo(label: HTMLElement, place: readonly [number, number] | undefined): void {
  label.style.left = `${place?.[0] ?? 0}px`;
  label.style.top = `${place?.[1] ?? 0}px`;
}
