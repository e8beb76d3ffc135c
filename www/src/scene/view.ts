// The view of the models and a result. Without WebGL it draws nothing.
import type { DiffResult, DistanceResult, Vector3 as Point } from "nurbs-hausdorff";
import { Vector3 } from "three";
import { farthestSide } from "../common/direction.ts";
import { element } from "../common/elements.ts";
import { certifiedText, distanceText } from "../common/numbers.ts";
import { type Change, classesOf } from "../faces/changes.ts";
import { Pins } from "../inspection/pins/pins.ts";
import type { FieldDisplay } from "../worker/field/fieldDisplay.ts";
import type { DisplayModel, Side, Sides } from "../worker/protocol.ts";
import { Axes } from "./camera/axes.ts";
import { STANDARD_VIEWS, type StandardView } from "./camera/standardViews.ts";
import { Viewport } from "./camera/viewport.ts";
import { cssColor } from "./colors/css.ts";
import type { ColorScale } from "./colors/scale.ts";
import { ScaleTexture } from "./colors/scaleTexture.ts";
import type { FaceClass } from "./faces.ts";
import { Gizmo, type GizmoMode, type OnGizmo } from "./gizmo.ts";
import type { Visibility } from "./mesh.ts";
import { Models } from "./models.ts";
import { Arrow } from "./overlays/arrow.ts";
import { ProjectionLines } from "./overlays/projectionLines.ts";
import type { Pose } from "./pose.ts";
import type { Section } from "./section.ts";

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

/** How the models are shown. */
export interface Display {
  visibility: Record<Side, Visibility>;
  orthographic: boolean;
  section: Section | undefined;
  gizmo: GizmoMode;
}

export class View {
  readonly pins = new Pins();
  readonly #scale = new ScaleTexture();
  readonly models = new Models({ a: cssColor("a"), b: cssColor("b") }, this.#scale.texture);
  readonly #arrow = new Arrow(element("label"), cssColor("accent"));
  readonly #lines = new ProjectionLines(this.#scale.texture);
  readonly #viewport: Viewport | undefined;
  readonly #gizmo: Gizmo | undefined;
  #overlays: Overlays = { deviation: false, lines: false, triangles: false };
  /** The unit of the deviations drawn. */
  #unit = 1;
  #result: DistanceResult | undefined;
  #diff: DiffResult | undefined;

  /** Opens a view in some short tasks; calls `withoutWebGl` with the reason if the browser cannot draw. */
  static async open(
    canvas: HTMLCanvasElement,
    withoutWebGl: (reason: string) => void,
    onGizmo: OnGizmo,
  ): Promise<View> {
    try {
      return new View(canvas, onGizmo, await Viewport.open(canvas));
    } catch (error) {
      element("tools").hidden = true;
      withoutWebGl(error instanceof Error ? error.message : `${error}`);
      return new View(canvas, onGizmo, undefined);
    }
  }

  private constructor(canvas: HTMLCanvasElement, onGizmo: OnGizmo, viewport: Viewport | undefined) {
    if (viewport === undefined) return;
    viewport.scene.add(this.models.group, this.#arrow.group, this.#lines.lines);
    this.#viewport = viewport;
    this.#gizmo = new Gizmo(viewport, canvas, onGizmo);
    const axes = new Axes(element("axes", SVGSVGElement));
    viewport.onDraw = () => {
      this.#arrow.update(viewport);
      this.pins.update(viewport, this.models.center);
      axes.update(viewport.camera);
    };
  }

  /** Shows models, each in place of the one before. */
  showModels(models: Sides<DisplayModel>): void {
    this.models.show(models);
    void this.#viewport?.compile();
  }

  fit(): void {
    this.#viewport?.fit(this.models.box);
  }

  /** Shows both models from a standard direction. */
  look(view: StandardView): void {
    this.#viewport?.fit(this.models.box, STANDARD_VIEWS[view]);
  }

  /** The point of a model at a position in the window, in that model's coordinates. */
  hit(clientX: number, clientY: number): { side: Side; near: Point } | undefined {
    if (this.#viewport === undefined || this.#gizmo?.dragging) return undefined;
    return this.models.hit(this.#viewport, clientX, clientY);
  }

  /** The result shown. */
  get result(): DistanceResult | undefined {
    return this.#result;
  }

  /** Draws again, after something over the view changed. */
  redraw(): void {
    this.#viewport?.draw();
  }

  /** Draws at once and without handles, so that the canvas can be read in the same task. */
  renderForExport(): void {
    this.#gizmo?.without(() => this.#viewport?.render());
    this.#viewport?.draw();
  }

  approachArrow(): void {
    if (!this.#arrow.group.visible) return;
    const radius = Math.max(
      APPROACH_RADIUS * this.#arrow.length,
      MIN_APPROACH_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(this.#arrow.middle, radius);
  }

  show(pose: Pose, overlays: Overlays, display: Display): void {
    this.#overlays = overlays;
    this.models.pose(pose);
    this.models.setDisplay(display.visibility, overlays.triangles);
    this.models.cut(display.section);
    if (this.#viewport !== undefined) this.#viewport.orthographic = display.orthographic;
    if (this.#gizmo !== undefined) {
      this.#gizmo.mode = display.gizmo;
      this.#gizmo.place(pose, this.models.center);
    }
  }

  /** Shows the arrow of a result; `replaced` removes the deviation of the one before. */
  showResult(result: DistanceResult, replaced: boolean): void {
    this.#result = result;
    if (this.#diff === undefined) this.#showArrow();
    if (replaced) this.#hideField();
    this.#viewport?.draw();
  }

  /** Shows the deviation of A, whose largest distance is `largest`. */
  showField(field: FieldDisplay, scale: ColorScale, largest: number): void {
    const { deviation, lines } = this.#overlays;
    this.#unit = largest;
    this.#scale.show(scale, largest);
    if (deviation) this.models.paint(field, largest);
    if (lines) this.#lines.show(field, largest, this.models.center);
    this.#viewport?.draw();
  }

  /** Recolours the deviation shown. */
  rescale(scale: ColorScale): void {
    this.#scale.show(scale, this.#unit);
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
    this.models.classify(
      diff === undefined ? {} : { a: classesOf(diff.facesOfA), b: classesOf(diff.facesOfB) },
    );
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
    const { witness, computed, lower, upper, diagonal } = this.#result;
    const [from, to] =
      farthestSide(this.#result) === "a" ? [witness.a, witness.b] : [witness.b, witness.a];
    const text = certifiedText(computed, [lower, upper], diagonal);
    this.#arrow.show(from.point, to.point, text, this.models.center);
  }

  #hideField(): void {
    this.models.clearPaint();
    this.#lines.hide();
  }
}

/** The classes of a model of whose faces only one has a class of its own. */
function only(face: number, [own = "plain"]: FaceClass[]): FaceClass[] {
  const classes: FaceClass[] = [];
  classes[face] = own;
  return classes;
}
