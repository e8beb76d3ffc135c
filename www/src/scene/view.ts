// The view of the models and a result. Without WebGL it draws nothing.
import type { DiffResult, DistanceResult, Field, Transform } from "nurbs-hausdorff";
import { Vector3 } from "three";
import { farthestSide } from "../common/direction.ts";
import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/numbers.ts";
import { type Change, classesOf } from "../faces/changes.ts";
import type { Sides } from "../worker/protocol.ts";
import { Viewport } from "./camera/viewport.ts";
import { cssColor, deviationGradient } from "./colors.ts";
import type { FaceClass } from "./faces.ts";
import { Models } from "./models.ts";
import { Arrow } from "./overlays/arrow.ts";
import { largestDistance } from "./overlays/deviation.ts";
import { ProjectionLines } from "./overlays/projectionLines.ts";
import type { Pose } from "./pose.ts";

/** The radius of the view around the arrow, in lengths of the arrow, and its minimum, in diagonals. */
const APPROACH_RADIUS = 2;
const MIN_APPROACH_RADIUS = 1e-5;
/** The radius of the view around a face, in diagonals of its box: a little more than its sphere's. */
const FACE_RADIUS = 0.6;

/** What is drawn in addition to the models. */
export interface Overlays {
  deviation: boolean;
  lines: boolean;
  triangles: boolean;
}

export class View {
  readonly models = new Models({ a: cssColor("a"), b: cssColor("b") });
  readonly #arrow = new Arrow(element("label"), cssColor("accent"));
  readonly #lines = new ProjectionLines();
  readonly #legend = element("legend");
  readonly #viewport: Viewport | undefined;
  #overlays: Overlays = { deviation: false, lines: false, triangles: false };
  #result: DistanceResult | undefined;
  #diff: DiffResult | undefined;

  /** Calls `withoutWebGl` with the reason if the browser cannot draw. */
  constructor(canvas: HTMLCanvasElement, withoutWebGl: (reason: string) => void) {
    element("scale").style.background = deviationGradient;
    try {
      const viewport = new Viewport(canvas);
      viewport.scene.add(this.models.group, this.#arrow.group, this.#lines.lines);
      viewport.onDraw = () =>
        this.#arrow.update(viewport.camera, canvas.clientWidth, canvas.clientHeight);
      this.#viewport = viewport;
    } catch (error) {
      element("tools").hidden = true;
      withoutWebGl(error instanceof Error ? error.message : `${error}`);
    }
  }

  fit(): void {
    this.#viewport?.fit(this.models.box);
  }

  approachArrow(): void {
    if (!this.#arrow.group.visible) return;
    const radius = Math.max(
      APPROACH_RADIUS * this.#arrow.length,
      MIN_APPROACH_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(this.#arrow.middle, radius);
  }

  show(pose: Pose, overlays: Overlays): void {
    this.#overlays = overlays;
    this.models.pose(pose);
    this.models.setDisplay(overlays.lines, overlays.triangles);
    this.#viewport?.draw();
  }

  /** Shows the arrow and, if the result has a field, the deviation of A, measured at `transform`. */
  showResult(result: DistanceResult, transform: Transform): void {
    this.#result = result;
    if (this.#diff === undefined) this.#showArrow();
    this.#hideField();
    const field = (result.forward ?? result).field;
    if (field !== undefined) this.#showField(field, result.diagonal, transform);
    this.#viewport?.draw();
  }

  hideResult(): void {
    this.#result = undefined;
    this.#showArrow();
    this.#hideField();
    this.#viewport?.draw();
  }

  /** Colours the faces that a comparison found changed and greys the others; without one, ends that. */
  showFaces(diff: DiffResult | undefined): void {
    this.#diff = diff;
    this.models.classify(diff === undefined ? {} : { a: classesOf(diff.a), b: classesOf(diff.b) });
    if (diff === undefined) this.#showArrow();
    else this.#arrow.hide();
    this.#viewport?.draw();
  }

  /** Zooms to one face of the comparison shown and greys all others; without one, shows all again. */
  selectFace(change: Change | undefined): void {
    const diff = this.#diff;
    if (diff === undefined) return;
    if (change === undefined) {
      this.showFaces(diff);
      return;
    }
    const { side, difference } = change;
    const { a, b } = difference.witness;
    const plain: Sides<FaceClass[]> = { a: [], b: [] };
    this.models.classify({ ...plain, [side]: only(difference.face, classesOf([difference])) });
    const [from, to] = side === "a" ? [a.point, b.point] : [b.point, a.point];
    const length = new Vector3(...from).distanceTo(new Vector3(...to));
    this.#arrow.show(from, to, distanceText(length, diff.diagonal), this.models.center);
    const box = this.models.faceBox(side, difference.face);
    for (const point of [from, to]) {
      box.expandByPoint(new Vector3(...point).sub(this.models.center));
    }
    const radius = Math.max(
      FACE_RADIUS * box.getSize(new Vector3()).length(),
      MIN_APPROACH_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(box.getCenter(new Vector3()), radius);
  }

  /** The arrow of the result, in the direction in which the distance is attained. */
  #showArrow(): void {
    if (this.#result === undefined) {
      this.#arrow.hide();
      return;
    }
    const { witness, computed, diagonal } = this.#result;
    const [from, to] =
      farthestSide(this.#result) === "a" ? [witness.a, witness.b] : [witness.b, witness.a];
    const text = distanceText(computed, diagonal);
    this.#arrow.show(from.point, to.point, text, this.models.center);
  }

  #showField(field: Field[], diagonal: number, transform: Transform): void {
    const { deviation, lines } = this.#overlays;
    const largest = largestDistance(field);
    if (deviation) this.models.paint(field, largest, transform);
    if (lines) this.#lines.show(field, largest, this.models.center);
    this.#legend.hidden = !(deviation || lines);
    element("scale-low").textContent = signedText(-largest, diagonal);
    element("scale-high").textContent = signedText(largest, diagonal);
  }

  #hideField(): void {
    this.models.clearPaint();
    this.#lines.hide();
    this.#legend.hidden = true;
  }
}

/** The classes of a model of whose faces only one has a class of its own. */
function only(face: number, [own = "plain"]: FaceClass[]): FaceClass[] {
  const classes: FaceClass[] = [];
  classes[face] = own;
  return classes;
}
