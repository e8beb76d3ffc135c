// The tool that puts an annotation at the next point that is clicked.
import type { Vector3 } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import type { Side } from "../worker/protocol.ts";

/** The point of a model at a position in the window. */
export interface Hit {
  side: Side;
  face: number;
  near: Vector3;
}

export interface ToolListener {
  hit: (x: number, y: number) => Hit | undefined;
  /** What the next click is for; `undefined` when it is for nothing special any more. */
  take: (taken: ((x: number, y: number) => void) | undefined) => void;
  begin: (hit: Hit) => void;
}

const button = element("annotate", HTMLButtonElement);
const hint = element("annotate-text");

export class AnnotationTool {
  readonly #listener: ToolListener;

  constructor(listener: ToolListener) {
    this.#listener = listener;
    button.addEventListener("click", () => this.#turn(!this.active));
    window.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || event.defaultPrevented || !this.active) return;
      event.preventDefault();
      this.end();
    });
  }

  /** Whether the next click puts an annotation. */
  get active(): boolean {
    return button.getAttribute("aria-pressed") === "true";
  }

  end(): void {
    if (this.active) this.#turn(false);
  }

  #turn(on: boolean): void {
    button.setAttribute("aria-pressed", `${on}`);
    const canvas = element("canvas");
    canvas.classList.toggle("picking", on);
    hint.hidden = !on;
    this.#listener.take(on ? (x, y) => this.#click(x, y) : undefined);
    // Enter is the middle of the view.
    if (on) canvas.focus({ preventScroll: true });
  }

  #click(x: number, y: number): void {
    const hit = this.#listener.hit(x, y);
    // A click beside the models is none of them.
    if (hit === undefined) return;
    this.end();
    this.#listener.begin(hit);
  }
}
