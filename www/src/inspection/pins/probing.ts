// Measures the point under the pointer, and shows or pins it.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import type { View } from "../../scene/view.ts";
import type { Client } from "../../worker/client.ts";
import type { Probe, Side } from "../../worker/protocol.ts";
import { onPointer } from "./pointer.ts";

/** A position in pixels of the view. */
type Place = readonly [x: number, y: number];

export class Probing {
  readonly #view: View;
  #newest = 0;
  /** The requests for points to pin, which a pointer that moves on does not withdraw. */
  readonly #pinned = new Set<number>();
  /** The requests of others, with what they do with the answer. */
  readonly #asked = new Map<number, (probe: Probe) => void>();
  readonly #ask: (side: Side, near: Vector3) => number;
  /** What the next click is for, instead of a pin. */
  #nextClick: ((clientX: number, clientY: number) => void) | undefined;
  /** The request for the point under the resting pointer. */
  #hovered: { id: number; at: Place } | undefined;

  constructor(canvas: HTMLCanvasElement, view: View, client: Client, transformOf: () => Transform) {
    this.#view = view;
    this.#ask = (side, near) => {
      this.#newest += 1;
      client.probe(this.#newest, side, near, transformOf(), view.models.scale);
      return this.#newest;
    };
    const request = (clientX: number, clientY: number, click: boolean) => {
      // A pin is of models as they stand.
      const pin = click && view.models.explosion.part === 0;
      if (click && this.#nextClick !== undefined) {
        this.#nextClick(clientX, clientY);
        return;
      }
      const hit = view.hit(clientX, clientY);
      if (hit === undefined) return;
      const id = this.#ask(hit.side, hit.near);
      const { left, top } = canvas.getBoundingClientRect();
      if (pin) this.#pinned.add(id);
      else this.#hovered = { id, at: [clientX - left, clientY - top] };
    };
    const leave = () => {
      this.#hovered = undefined;
      view.pins.hover();
    };
    onPointer(canvas, request, leave, () => view.middle);
  }

  /** Gives the next clicks on the view to `taken` instead of pinning points; `undefined` ends that. */
  set nextClick(taken: ((clientX: number, clientY: number) => void) | undefined) {
    this.#nextClick = taken;
    this.#view.isPicked = taken !== undefined;
  }

  /** Measures the point of a model that is nearest to one in its own coordinates. */
  ask(side: Side, near: Vector3, answered: (probe: Probe) => void): void {
    this.#asked.set(this.#ask(side, near), answered);
  }

  /** Pins a measured point, or shows it, unless the pointer moved on. */
  show(id: number, probe: Probe | undefined): void {
    const pin = this.#pinned.delete(id);
    const answered = this.#asked.get(id);
    this.#asked.delete(id);
    if (probe === undefined) return;
    answered?.(probe);
    const { diagonal } = this.#view.models;
    if (pin) this.#view.pins.add(probe, diagonal, () => this.#view.redraw());
    else if (id === this.#hovered?.id) this.#view.pins.hover(probe, diagonal, this.#hovered.at);
  }

  /** Removes all points, those that are being measured too. */
  clear(): void {
    this.#pinned.clear();
    this.#asked.clear();
    this.#hovered = undefined;
    this.#view.pins.clear();
  }
}
