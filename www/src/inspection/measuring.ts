// Measuring in the view: the distance of two points that are clicked, its parts along the axes, and
// the angle of the faces there. Points are of the drawn triangles: estimates, and said to be.
import type { Vector3 } from "three";
import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import type { View } from "../scene/view.ts";
import { PickingTool, type Take } from "./pickingTool.ts";

/** A place of a model in the scene. */
interface Facing {
  point: Vector3;
  normal: Vector3;
}

const text = element("measure-text");

const FIRST = "Click a first point. Esc ends measuring.";
const SECOND = "Click a second point.";

export class Measuring {
  readonly #view: View;
  readonly #tool: PickingTool;
  #first: Facing | undefined;

  constructor(view: View, take: Take) {
    this.#view = view;
    this.#tool = new PickingTool({
      button: element("measure", HTMLButtonElement),
      take,
      click: (x, y) => this.#click(view.facing(x, y)),
      turned: (on) => this.#turned(on),
    });
  }

  /** Whether clicks on the view measure. */
  get active(): boolean {
    return this.#tool.active;
  }

  /** Ends measuring, and shows the result's arrow again. */
  end(): void {
    this.#tool.end();
  }

  #turned(on: boolean): void {
    this.#first = undefined;
    text.hidden = !on;
    text.textContent = FIRST;
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
