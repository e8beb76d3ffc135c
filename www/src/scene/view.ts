// The view of the models and a result. Without WebGL it draws nothing.
import type { DiffResult, DistanceResult, Vector3 as Point } from "nurbs-hausdorff";
import { Box3, Vector3 } from "three";
import { agrees } from "../common/direction.ts";
import { element } from "../common/elements.ts";
import { heldText } from "../common/text/numbers.ts";
import { type Change, classesOf, classOf } from "../faces/changes.ts";
import { Pins } from "../inspection/pins/pins.ts";
import type { MapDisplay } from "../worker/map/display.ts";
import { type DisplayModel, type Draft, SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { ViewCube } from "./camera/cube.ts";
import { STANDARD_VIEWS, type StandardView } from "./camera/standardViews.ts";
import { Viewport } from "./camera/viewport.ts";
import { cssColor } from "./colors/css.ts";
import type { ColorScale } from "./colors/scale.ts";
import { ScaleTexture } from "./colors/scaleTexture.ts";
import type { FaceClass } from "./faces.ts";
import { Gizmo, type GizmoMode, type OnGizmo } from "./gizmo.ts";
import type { Visibility } from "./mesh.ts";
import { Models } from "./models.ts";
import { Arrow, type ArrowTexts } from "./overlays/arrow.ts";
import { ProjectionLines } from "./overlays/projectionLines.ts";
import { arrowOf } from "./overlays/resultArrow.ts";
import type { Pose } from "./pose.ts";
import type { Section } from "./section.ts";

/** The radius of the view around the arrow, in lengths of the arrow, and its minimum, in diagonals. */
const APPROACH_RADIUS = 2;
const MIN_APPROACH_RADIUS = 1e-5;
/** The least radius of the view around a place of a map, in diagonals: what surrounds it is seen. */
const PLACE_RADIUS = 0.12;
/** The radius of the view around a face, in diagonals of its box: a little more than its sphere's. */
const FACE_RADIUS = 0.6;

/** What is drawn in addition to the models. */
export interface Overlays {
  deviation: boolean;
  lines: boolean;
  triangles: boolean;
}

/** An arrow between two points of a result, or a mark where both are the same. */
export interface ShownArrow {
  from: Point;
  to: Point;
  texts: ArrowTexts;
}

/** How the models are shown. */
export interface Display {
  visibility: Record<Side, Visibility>;
  orthographic: boolean;
  section: Section | undefined;
  gizmo: GizmoMode;
  /** The part of the view, from the left, that shows A only, and the rest B. */
  wipe: number | undefined;
  /** Whether what is not painted has the colours of its file. */
  fileColors: boolean;
}

export class View {
  readonly pins = new Pins();
  readonly #scale = new ScaleTexture();
  readonly models = new Models({ a: cssColor("a"), b: cssColor("b") }, this.#scale.texture);
  readonly #arrow = new Arrow(
    element("label"),
    [element("label-from"), element("label-to")],
    cssColor("accent"),
  );
  readonly #lines = {
    a: new ProjectionLines(this.#scale.texture),
    b: new ProjectionLines(this.#scale.texture),
  };
  readonly #viewport: Viewport | undefined;
  readonly #gizmo: Gizmo | undefined;
  #overlays: Overlays = { deviation: false, lines: false, triangles: false };
  /** The unit of the deviations drawn. */
  #unit = 1;
  #result: DistanceResult | undefined;
  #diff: DiffResult | undefined;
  #diffSide: Side | undefined;
  /** Whether bodies are shown alone, of which the result is not. */
  #isOfBodies = false;
  /** The box of the files that are being read, as the camera was placed for it. */
  #drawn = new Box3();

  /**
   * Opens a view in some short tasks; calls `withoutWebGl` with the reason if the browser cannot draw,
   * and `onContext` when it no longer can for a while.
   */
  static async open(
    canvas: HTMLCanvasElement,
    withoutWebGl: (reason: string) => void,
    onContext: (isThere: boolean) => void,
    onGizmo: OnGizmo,
  ): Promise<View> {
    try {
      const viewport = await Viewport.open(canvas);
      viewport.onContext = onContext;
      return new View(canvas, onGizmo, viewport);
    } catch (error) {
      element("tools").hidden = true;
      element("axes", SVGSVGElement).toggleAttribute("hidden", true);
      withoutWebGl(error instanceof Error ? error.message : `${error}`);
      return new View(canvas, onGizmo, undefined);
    }
  }

  private constructor(canvas: HTMLCanvasElement, onGizmo: OnGizmo, viewport: Viewport | undefined) {
    if (viewport === undefined) return;
    viewport.scene.add(
      this.models.group,
      this.#arrow.group,
      this.#lines.a.lines,
      this.#lines.b.lines,
    );
    this.#viewport = viewport;
    viewport.keepClear(...["legend", "context", "cut", "foot"].map((id) => element(id)));
    this.#gizmo = new Gizmo(viewport, canvas, onGizmo);
    const cube = new ViewCube(element("axes", SVGSVGElement), (view) => this.look(view));
    viewport.onDraw = () => {
      this.#arrow.update(viewport);
      this.pins.update(viewport, this.models.center, this.models.planes);
      cube.update(viewport.camera);
    };
  }

  /** Shows models, each in place of the one before. */
  showModels(models: Sides<DisplayModel>): void {
    this.models.show(models);
    this.#drawn.makeEmpty();
    void this.#viewport?.compile();
  }

  /** Shows faces of a file that is being read, all of them in view. */
  showDraft(side: Side, replaced: readonly Side[], draft: Draft): void {
    this.models.showDraft(side, replaced, draft);
    if (!this.#drawn.containsBox(this.models.box)) {
      this.#drawn = this.models.box;
      this.fit(true);
    }
    this.#viewport?.draw();
  }

  /** Whether a file is being read of which faces are drawn already. */
  get isDrafting(): boolean {
    return this.models.isDrafting;
  }

  /** Shows the models before again, since their replacement was not read; returns whether they were not shown. */
  dropDrafts(): boolean {
    this.#drawn.makeEmpty();
    return this.models.dropDrafts();
  }

  /** The faces of a model close. */
  close(side: Side): void {
    this.models.close(side);
  }

  /** Shows both models; `atOnce` without a way to it. */
  fit(atOnce = false): void {
    this.#viewport?.fit(this.models.box, undefined, atOnce);
  }

  /** Shows both models, as they are looked at now, if a part of them is outside of the view. */
  keepInView(): void {
    const { box } = this.models;
    if (this.#viewport === undefined || this.#viewport.holds(box)) return;
    this.#viewport.fit(box, this.#viewport.seen.normal);
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

  /** The point of a model at a position in the window, with its normal, in the scene. */
  facing(clientX: number, clientY: number): { point: Vector3; normal: Vector3 } | undefined {
    return this.#viewport && this.models.facing(this.#viewport, clientX, clientY);
  }

  /** What the view looks at, and the direction from there to the eye. */
  get seen(): { point: Vector3; normal: Vector3 } | undefined {
    return this.#viewport?.seen;
  }

  /** The result shown. */
  get result(): DistanceResult | undefined {
    return this.#result;
  }

  /** Draws again, after something over the view changed. */
  redraw(): void {
    this.#viewport?.draw();
  }

  /** Looks at a point of the scene from near, at once, from where its surface is seen. */
  lookAt(point: Vector3, normal: Vector3): void {
    this.#viewport?.approachAtOnce(point, PLACE_RADIUS * this.models.diagonal, normal);
  }

  /** Marks a point of the scene instead of showing an arrow; returns the function that shows that again. */
  mark(point: Vector3): () => void {
    const before = this.#arrow.shown;
    const at = point.clone().add(this.models.center).toArray();
    this.#arrow.show(at, at, { length: "", from: "", to: "" }, this.models.center);
    return () => {
      if (before === undefined) this.#arrow.hide();
      else this.#arrow.show(...before);
    };
  }

  /** Draws at once and without handles, so that the canvas can be read in the same task. */
  renderForExport(): void {
    this.#gizmo?.without(() => this.#viewport?.render());
    this.#viewport?.draw();
  }

  /** Calls back when the user moved the camera by hand. */
  onCamera(callback: (place: number[]) => void): void {
    const viewport = this.#viewport;
    viewport?.controls.addEventListener("end", () => callback(viewport.place));
  }

  /** Where the camera is, to show the same view again; none without WebGL. */
  get camera(): number[] {
    return this.#viewport?.place ?? [];
  }

  set camera(place: number[]) {
    if (this.#viewport !== undefined) this.#viewport.place = place;
  }

  /** Zooms to a point of a result, and shows an arrow from it to its foot. */
  approach(from: Point, to: Point, texts: ArrowTexts, normal?: Vector3): void {
    this.#arrow.show(from, to, texts, this.models.center);
    const radius = Math.max(
      APPROACH_RADIUS * this.#arrow.length,
      PLACE_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(this.#arrow.middle, radius, normal);
  }

  /** Shows an arrow between two points of a result, or that of the result again. */
  point(arrow?: ShownArrow): void {
    if (arrow === undefined) this.#showArrow();
    else this.#arrow.show(arrow.from, arrow.to, arrow.texts, this.models.center);
    this.#viewport?.draw();
  }

  /** Shows what was seen before a place was shown from near. */
  back(): void {
    this.#viewport?.back();
  }

  /** Draws all faces of a model but these. */
  hideFaces(side: Side, hidden: ReadonlySet<number>): void {
    this.models.hideFaces(side, hidden);
    this.#viewport?.draw();
  }

  /**
   * Shows faces alone in these classes, with an arrow or without one; without faces, models and their result
   * again. What is hidden is the tree's.
   */
  showBodies(shown?: { classes: Sides<FaceClass[]>; arrow: ShownArrow | undefined }): void {
    this.#isOfBodies = shown !== undefined;
    this.models.classify(shown?.classes ?? {});
    if (shown === undefined) this.#showArrow();
    else if (shown.arrow === undefined) this.#arrow.hide();
    else this.point(shown.arrow);
    this.#viewport?.draw();
  }

  /** Zooms to faces. */
  approachFaces(faces: Sides<readonly number[]>): void {
    const box = new Box3();
    for (const side of SIDES) {
      for (const face of faces[side] ?? []) box.union(this.models.faceBox(side, face));
    }
    if (box.isEmpty()) return;
    const size = FACE_RADIUS * box.getSize(new Vector3()).length();
    const radius = Math.max(size, MIN_APPROACH_RADIUS * this.models.diagonal);
    this.#viewport?.approach(box.getCenter(new Vector3()), radius);
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
    this.models.fileColors = display.fileColors;
    this.models.cutOpen(display.section);
    if (this.#viewport !== undefined) {
      this.#viewport.orthographic = display.orthographic;
      const { wipe } = display;
      this.#viewport.wipe =
        wipe === undefined
          ? undefined
          : {
              fraction: wipe,
              only: (left) => this.models.only(left === undefined ? undefined : left ? "a" : "b"),
            };
    }
    if (this.#gizmo !== undefined) {
      this.#gizmo.mode = display.gizmo;
      this.#gizmo.place(pose, this.models.center);
    }
  }

  /** Shows the arrow of a result; `replaced` removes the deviation of the one before. */
  showResult(result: DistanceResult, replaced: boolean): void {
    this.#result = result;
    if (this.#diff === undefined && !this.#isOfBodies) this.#showArrow();
    if (replaced) this.#hideMaps();
    this.#viewport?.draw();
  }

  /** Shows the deviations of models, whose largest distance is `largest`. */
  showMaps(maps: Sides<MapDisplay>, scale: ColorScale, largest: number): void {
    const { deviation, lines } = this.#overlays;
    this.#unit = largest;
    this.#scale.show(scale, largest);
    this.models.paint(deviation ? maps : {}, largest);
    for (const side of SIDES) {
      const map = maps[side];
      if (lines && map) this.#lines[side].show(map, largest, this.models.center);
      else this.#lines[side].hide();
    }
    this.#viewport?.draw();
  }

  /** Recolours the deviation shown. */
  rescale(scale: ColorScale): void {
    this.#scale.show(scale, this.#unit);
    this.#viewport?.draw();
  }

  hideResult(): void {
    this.#result = undefined;
    if (!this.#isOfBodies) this.#showArrow();
    this.#hideMaps();
    this.#viewport?.draw();
  }

  /**
   * Colours the faces that a comparison found changed and greys the others, of one model or of both;
   * without a comparison, ends that.
   */
  showFaces(diff: DiffResult | undefined, side?: Side): void {
    this.#diff = diff;
    this.#diffSide = side;
    this.models.alone = diff === undefined ? undefined : side;
    this.models.classify(
      diff === undefined ? {} : { a: classesOf(diff, "a"), b: classesOf(diff, "b") },
    );
    if (diff === undefined) this.#showArrow();
    else this.#arrow.hide();
    this.#viewport?.draw();
  }

  /** Colours faces by classes of any kind, and greys the others; without any, ends that. */
  classify(classes: Sides<FaceClass[]>): void {
    this.models.classify(classes);
    this.#viewport?.draw();
  }

  /** Zooms to one face of the comparison shown and greys all others; without one, shows all again. */
  selectFace(change: Change | undefined): void {
    const diff = this.#diff;
    if (diff === undefined) return;
    if (change === undefined) {
      this.showFaces(diff, this.#diffSide);
      return;
    }
    const { side, difference, kind } = change;
    this.models.alone = side;
    const { a, b } = difference.witness;
    const plain: Sides<FaceClass[]> = { a: [], b: [] };
    this.models.classify({ ...plain, [side]: only(difference.face, classOf(kind)) });
    const [from, to] = side === "a" ? [a.point, b.point] : [b.point, a.point];
    const { lower, upper } = difference;
    const texts = { length: heldText([lower, upper], diff.diagonal), from: "", to: "" };
    this.#arrow.show(from, to, texts, this.models.center);
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
    if (this.#result === undefined || agrees(this.#result)) {
      this.#arrow.hide();
      return;
    }
    const { from, to, texts } = arrowOf(this.#result);
    this.#arrow.show(from, to, texts, this.models.center);
  }

  #hideMaps(): void {
    this.models.paint({}, 1);
    for (const lines of Object.values(this.#lines)) lines.hide();
  }
}

/** The classes of a model of whose faces only one has a class of its own. */
function only(face: number, own: FaceClass): FaceClass[] {
  const classes: FaceClass[] = [];
  classes[face] = own;
  return classes;
}
