// Measures the point under the pointer, and shows or pins it.
import type { Transform } from "nurbs-hausdorff";
import type { View } from "../../scene/view.ts";
import type { Client } from "../../worker/client.ts";
import type { Probe } from "../../worker/protocol.ts";
import { onPointer } from "./pointer.ts";

interface Request {
  id: number;
  pin: boolean;
  /** Where the point is, in pixels of the view. */
  at: readonly [number, number];
}

export class Probing {
  readonly #view: View;
  #newest: Request = { id: 0, pin: false, at: [0, 0] };

  constructor(canvas: HTMLCanvasElement, view: View, client: Client, transformOf: () => Transform) {
    this.#view = view;
    const request = (clientX: number, clientY: number, pin: boolean) => {
      const hit = view.hit(clientX, clientY);
      if (hit === undefined) return;
      const { left, top } = canvas.getBoundingClientRect();
      const at = [clientX - left, clientY - top] as const;
      this.#newest = { id: this.#newest.id + 1, pin, at };
      client.probe(this.#newest.id, hit.side, hit.near, transformOf(), view.models.scale);
    };
    onPointer(canvas, request, () => {
      if (!this.#newest.pin) this.#newest = { ...this.#newest, id: this.#newest.id + 1 };
      view.pins.hover();
    });
  }

  /** Shows a measured point, unless the pointer moved on. */
  show(id: number, probe: Probe | undefined): void {
    const { pin, at, id: newest } = this.#newest;
    if (id !== newest || probe === undefined) return;
    const { diagonal } = this.#view.models;
    if (pin) this.#view.pins.add(probe, diagonal, () => this.#view.redraw());
    else this.#view.pins.hover(probe, diagonal, at);
  }
}
