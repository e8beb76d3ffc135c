// The tool that measures in the view: the distance of two points that are clicked, its parts along the axes and the
// angle of the faces there; the radius of a face or of an edge; the length of an edge.
import type { Vector3 } from "three";
import { element } from "../common/elements.ts";
import { PickingTool, type Take } from "../inspection/pickingTool.ts";
import type { ArrowTexts } from "../scene/overlays/arrow.ts";
import type { View } from "../scene/view.ts";
import { field, onChange } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import { edgeNear } from "./edges.ts";
import { roundFace } from "./faces.ts";
import { minus } from "./fit/linear.ts";
import { addMeasure, type Measure, type Place } from "./measures.ts";
import type { Value } from "./said.ts";
import { measured } from "./values.ts";

const text = element("measure-text");
const own = texts.measuring;
const what = field("measure");

/** Pixels within which a round edge is meant where the face is round as well. */
const EDGE_REACH = 8;

export class Measuring {
  readonly #view: View;
  readonly #tool: PickingTool;
  #first: Place | undefined;

  constructor(view: View, take: Take) {
    this.#view = view;
    this.#tool = new PickingTool({
      button: element("measure", HTMLButtonElement),
      take,
      click: (x, y) => this.#click(x, y),
      turned: (on) => this.#turned(on),
    });
    onChange(
      () => what.value,
      () => this.active && this.#ask(),
    );
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
    element("measure-controls").hidden = !on;
    this.#ask();
    // Of models as they stand.
    if (on) this.#view.onPlace();
    else this.#view.point();
    // Enter is the middle of the view.
    if (on) element("canvas").focus({ preventScroll: true });
  }

  #ask(): void {
    // The mark of a first point is that of no other measurement.
    if (this.#first !== undefined) this.#view.point();
    this.#first = undefined;
    text.textContent =
      what.value === "edge" ? own.edge : what.value === "radius" ? own.radius : own.firstPoint;
  }

  #click(x: number, y: number): void {
    const hit = this.#view.hit(x, y);
    // A click that hits no model measures nothing.
    if (hit === undefined) return;
    const place: Place = {
      ...{ side: hit.side, face: hit.face, point: hit.near, normal: hit.normal },
    };
    if (what.value !== "points") this.#keep(this.#ofPlace(place));
    else if (this.#first === undefined) {
      this.#first = place;
      text.textContent = own.secondPoint;
      const start = measured({ what: "points", places: [place, place] }, this.#view.models);
      if (start !== undefined) showValue(this.#view, { ...start, label: "" });
    } else {
      this.#keep({ what: "points", places: [this.#first, place] });
      this.#first = undefined;
    }
  }

  /** What is measured by a single click. */
  #ofPlace(place: Place): Measure {
    if (what.value === "edge") return { what: "edge", places: [place] };
    const model = this.#view.models.drawn[place.side];
    if (model === undefined) return { what: "radius", places: [place] };
    const near = edgeNear(model, place.face, minus(place.point, model.tessellation.origin));
    const isRound = near?.edge.circle !== undefined;
    const reach = EDGE_REACH * this.#view.pixelAt(place.side, place.point);
    const isMeant = roundFace(model, place.face) === undefined || (near?.distance ?? 0) < reach;
    return { what: isRound && isMeant ? "circle" : "radius", places: [place] };
  }

  /** Shows what was measured and keeps it, where there is such a thing. */
  #keep(measure: Measure): void {
    const value = measured(measure, this.#view.models);
    if (value === undefined) {
      text.textContent = measure.what === "edge" ? own.noEdge : own.noRadius;
      return;
    }
    showValue(this.#view, value);
    const isFull = addMeasure(measure) === undefined;
    text.textContent = isFull ? `${value.text} ${own.full}` : value.text;
  }
}

/** The arrow of a measurement, in the coordinates of the models. */
export function arrowOf({ from, to, label }: Value, center: Vector3) {
  const [start, end] = [from, to].map((point) => point.clone().add(center).toArray());
  const texts: ArrowTexts = { length: label, from: "", to: "" };
  return [start ?? NOWHERE, end ?? NOWHERE, texts] as const;
}

const NOWHERE: [number, number, number] = [0, 0, 0];

function showValue(view: View, value: Value): void {
  const [from, to, texts] = arrowOf(value, view.models.center);
  view.point({ from, to, texts });
}
