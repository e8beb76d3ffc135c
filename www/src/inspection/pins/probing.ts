// Measures the point under the pointer, and shows or pins it.
import type { Transform } from "nurbs-hausdorff";
import type { View } from "../../scene/view.ts";
import type { Client } from "../../worker/client.ts";
import type { Probe } from "../../worker/protocol.ts";
import { onPointer } from "./pointer.ts";

/** A position in pixels of the view. */
type Place = readonly [x: number, y: number];

export class Probing {
  readonly #view: View;
  #newest = 0;
  /** The requests for points to pin, which a pointer that moves on does not withdraw. */
  readonly #pinned = new Set<number>();
  /** The request for the point under the resting pointer. */
  #hovered: { id: number; at: Place } | undefined;

  constructor(canvas: HTMLCanvasElement, view: View, client: Client, transformOf: () => Transform) {
    this.#view = view;
    const request = (clientX: number, clientY: number, pin: boolean) => {
      const hit = view.hit(clientX, clientY);
      if (hit === undefined) return;
      this.#newest += 1;
      const { left, top } = canvas.getBoundingClientRect();
      if (pin) this.#pinned.add(this.#newest);
      else this.#hovered = { id: this.#newest, at: [clientX - left, clientY - top] };
      client.probe(this.#newest, hit.side, hit.near, transformOf(), view.models.scale);
    };
    onPointer(canvas, request, () => {
      this.#hovered = undefined;
      view.pins.hover();
    });
  }

  /** Pins a measured point, or shows it, unless the pointer moved on. */
  show(id: number, probe: Probe | undefined): void {
    const pin = this.#pinned.delete(id);
    if (probe === undefined) return;
    const { diagonal } = this.#view.models;
    if (pin) this.#view.pins.add(probe, diagonal, () => this.#view.redraw());
    else if (id === this.#hovered?.id) this.#view.pins.hover(probe, diagonal, this.#hovered.at);
  }

  /** Removes all points, those that are being measured too. */
  clear(): void {
    this.#pinned.clear();
    this.#hovered = undefined;
    this.#view.pins.clear();
  }
}
