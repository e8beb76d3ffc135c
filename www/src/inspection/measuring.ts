// Measuring in the view: the distance of two points that are clicked, its parts along the axes, and
// the angle of the faces there. Points are of the drawn triangles: estimates, and said to be.
import type { Vector3 } from "three";
import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import type { View } from "../scene/view.ts";

/** A place of a model in the scene. */
interface Facing {
  point: Vector3;
  normal: Vector3;
}

const button = element("measure", HTMLButtonElement);
const text = element("measure-text");

const FIRST = "Click a first point. Esc ends measuring.";
const SECOND = "Click a second point.";

export class Measuring {
  readonly #view: View;
  readonly #take: (taken: ((x: number, y: number) => void) | undefined) => void;
  #first: Facing | undefined;

  /** Gives `take` what the next clicks are for, and `undefined` when they are no longer. */
  constructor(view: View, take: (taken: ((x: number, y: number) => void) | undefined) => void) {
    this.#view = view;
    this.#take = take;
    button.addEventListener("click", () => this.#turn(!this.active));
    window.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || event.defaultPrevented || !this.active) return;
      event.preventDefault();
      this.end();
    });
  }

  /** Whether clicks on the view measure. */
  get active(): boolean {
    return button.getAttribute("aria-pressed") === "true";
  }

  /** Ends measuring, and shows the result's arrow again. */
  end(): void {
    if (this.active) this.#turn(false);
  }

  #turn(on: boolean): void {
    button.setAttribute("aria-pressed", `${on}`);
    element("canvas").classList.toggle("picking", on);
    this.#first = undefined;
    text.hidden = !on;
    text.textContent = FIRST;
    this.#take(on ? (x, y) => this.#click(this.#view.facing(x, y)) : undefined);
    // Of models as they stand.
    if (on) this.#view.onPlace();
    else this.#view.point();
  }

  #click(facing: Facing | undefined): void {
    // A click beside the models is none of them.
    if (facing === undefined) return;
    if (this.#first === undefined) {
      this.#first = facing;
      text.textContent = SECOND;
      this.#show(facing, facing, "");
      return;
    }
    const { diagonal } = this.#view.models;
    const way = facing.point.clone().sub(this.#first.point);
    const unit = commonUnit() ?? "model units";
    const length = distanceText(way.length(), diagonal);
    const parts = way.toArray().map((part, axis) => `${"xyz"[axis]} ${signedText(part, diagonal)}`);
    const angle = (facing.normal.angleTo(this.#first.normal) * 180) / Math.PI;
    text.textContent = `≈ ${length} ${unit} · ${parts.join(" · ")} · faces turned by ${angle.toFixed(1)}°`;
    this.#show(this.#first, facing, `≈ ${length}`);
    this.#first = undefined;
  }

  #show(from: Facing, to: Facing, length: string): void {
    const [start, end] = [from, to].map(({ point }) => {
      const [x, y, z] = point.clone().add(this.#view.models.center).toArray();
      return [x, y, z] as const;
    });
    if (start === undefined || end === undefined) return;
    this.#view.point({ from: [...start], to: [...end], texts: { length, from: "", to: "" } });
  }
}
