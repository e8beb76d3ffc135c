// The view of the models and a result. Without WebGL it draws nothing.
import type { DiffResult, DistanceResult, Vector3 as Point } from "nurbs-hausdorff";
import { Box3, Vector3 } from "three";
import { agrees } from "../common/direction.ts";
import { element } from "../common/elements.ts";
import type { Change } from "../faces/changes.ts";
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
import { Gizmo, type OnGizmo } from "./gizmo.ts";
import { Models } from "./models.ts";
import { Arrow, type ArrowTexts } from "./overlays/arrow.ts";
import { arrowOf } from "./overlays/resultArrow.ts";
import { nearestHit } from "./picking/nearest.ts";
import type { Pose } from "./pose.ts";
import { type Around, ChangedFaces } from "./shown/changedFaces.ts";
import type { Display, Overlays, ShownArrow } from "./shown/display.ts";
import { ShownMaps } from "./shown/maps.ts";

/** The radius of the view around the arrow, in lengths of the arrow, and its minimum, in diagonals. */
const APPROACH_RADIUS = 2;
const MIN_APPROACH_RADIUS = 1e-5;
/** The least radius of the view around a place of a map, in diagonals: what surrounds it is seen. */
const PLACE_RADIUS = 0.12;
/** The radius of the view around a face, in diagonals of its box: a little more than its sphere's. */
const FACE_RADIUS = 0.6;

export class View {
  readonly pins = new Pins();
  readonly #scale = new ScaleTexture();
  readonly models = new Models({ a: cssColor("a"), b: cssColor("b") }, this.#scale.texture);
  readonly #arrow = new Arrow(
    element("label"),
    [element("label-from"), element("label-to")],
    cssColor("accent"),
  );
  readonly #maps = new ShownMaps(this.models, this.#scale);
  readonly #changed = new ChangedFaces(this.models, this.#arrow);
  readonly #viewport: Viewport | undefined;
  readonly #gizmo: Gizmo | undefined;
  /** What lies over the view and follows points of the models. */
  readonly #followers: ((viewport: Viewport) => void)[] = [];
  /** Called where a place is shown, which is one of models as they stand. */
  onPlace: () => void = () => {};
  #overlays: Overlays = { deviation: false, lines: false, triangles: false };
  #result: DistanceResult | undefined;
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
    viewport.scene.add(this.models.group, this.#arrow.group, ...this.#maps.objects);
    this.#viewport = viewport;
    viewport.keepClear(...["legend", "context", "cut", "foot"].map((id) => element(id)));
    this.#gizmo = new Gizmo(viewport, canvas, onGizmo);
    const cube = new ViewCube(element("axes", SVGSVGElement), (view) => this.look(view));
    viewport.onDraw = () => {
      this.#arrow.update(viewport);
      this.pins.update(viewport, this.models);
      for (const follow of this.#followers) follow(viewport);
      cube.update(viewport.camera);
    };
  }

  /** Whether a tool takes the clicks on the view: the models do not move between two of them. */
  set isPicked(isPicked: boolean) {
    if (this.#viewport !== undefined) this.#viewport.isPicked = isPicked;
  }

  /** Calls back before each drawing, to move what follows points of the models. */
  follow(callback: (viewport: Viewport) => void): void {
    this.#followers.push(callback);
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

  /** The place of a model nearest to the middle of what is seen, in pixels of the window; undefined without a view. */
  get middle(): readonly [clientX: number, clientY: number] | undefined {
    if (this.#viewport === undefined) return undefined;
    return nearestHit(this.#viewport.middle, ([x, y]) => this.hit(x, y) !== undefined);
  }

  /** The point of a model at a position in the window, in that model's coordinates. */
  hit(clientX: number, clientY: number): ReturnType<Models["hit"]> {
    if (this.#viewport === undefined || this.#gizmo?.dragging) return undefined;
    return this.models.hit(this.#viewport, clientX, clientY);
  }

  /** The point of a model at a position in the window, with its normal, in the scene. */
  facing(clientX: number, clientY: number): { point: Vector3; normal: Vector3 } | undefined {
    return this.#viewport && this.models.facing(this.#viewport, clientX, clientY);
  }

  /** The size of a pixel at a point of a model, in the model's own coordinates and unit. */
  pixelAt(side: Side, point: Point): number {
    const origin = this.models.drawn[side]?.tessellation.origin ?? [0, 0, 0];
    const [x, y, z] = point.map((at, axis) => at - (origin[axis] ?? 0)) as Point;
    const pixel = this.#viewport?.pixelAt(this.models.place(side, [x, y, z])) ?? 0;
    return side === "b" ? pixel / this.models.scale : pixel;
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
    this.onPlace();
    this.#arrow.show(from, to, texts, this.models.center);
    const radius = Math.max(
      APPROACH_RADIUS * this.#arrow.length,
      PLACE_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(this.#arrow.middle, radius, normal);
  }

  /** Shows an arrow between two points of a result, or that of the result again. */
  point(arrow?: ShownArrow): void {
    if (arrow !== undefined) this.onPlace();
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
    const size = box.getSize(new Vector3()).length();
    this.#approach({ center: box.getCenter(new Vector3()), size });
  }

  #approach({ center, size }: Around): void {
    const radius = Math.max(FACE_RADIUS * size, MIN_APPROACH_RADIUS * this.models.diagonal);
    this.#viewport?.approach(center, radius);
  }

  approachArrow(): void {
    if (!this.#arrow.group.visible) return;
    const radius = Math.max(
      APPROACH_RADIUS * this.#arrow.length,
      MIN_APPROACH_RADIUS * this.models.diagonal,
    );
    this.#viewport?.approach(this.#arrow.middle, radius);
  }

  /** Looks at a point of a face from near, in the model's own coordinates. */
  approachPoint(side: Side, face: number, point: Point): void {
    const at = this.models.pointOf(side, face, point);
    if (at !== undefined) this.#viewport?.approach(at, PLACE_RADIUS * this.models.diagonal);
  }

  /** Moves bodies apart; the result's arrow is one of models as they stand. */
  #explode(part: number): void {
    const before = this.models.explosion.part;
    if (part === 0 && before === 0) return;
    this.models.explode(part);
    if (part > 0) this.#arrow.hide();
    else if (!this.#changed.active && !this.#isOfBodies) this.#showArrow();
    this.#viewport?.refit(this.models.box);
    this.#viewport?.draw();
  }

  show(pose: Pose, overlays: Overlays, display: Display): void {
    this.#overlays = overlays;
    this.models.pose(pose);
    this.#explode(display.exploded);
    this.models.setDisplay(display.visibility, overlays.triangles);
    this.models.fileColors = display.fileColors;
    const wasCut = this.models.cut !== undefined;
    this.models.cutOpen(display.section);
    if (this.#viewport !== undefined) {
      // What is clipped has shaders of its own.
      if (!wasCut && this.models.cut !== undefined) void this.#viewport.compile();
      this.#viewport.orthographic = display.orthographic;
      const { wipe } = display;
      this.#viewport.wipe =
        wipe === undefined
          ? undefined
          : {
              ...wipe,
              only: (left) => this.models.only(left === undefined ? undefined : left ? "a" : "b"),
            };
    }
    if (this.#gizmo !== undefined) {
      // Handles are of one view.
      this.#gizmo.mode = display.wipe?.isBeside ? "none" : display.gizmo;
      this.#gizmo.place(pose, this.models.center);
    }
  }

  /** Shows the arrow of a result; `replaced` removes the deviation of the one before. */
  showResult(result: DistanceResult, replaced: boolean): void {
    this.#result = result;
    if (!this.#changed.active && !this.#isOfBodies) this.#showArrow();
    if (replaced) this.#maps.hide();
    this.#viewport?.draw();
  }

  /** Shows the deviations of models. */
  showMaps(maps: Sides<MapDisplay>, scale: ColorScale): void {
    this.#maps.show(maps, scale, this.#overlays);
    this.#viewport?.draw();
  }

  /** Recolours the deviation shown. */
  rescale(scale: ColorScale): void {
    this.#maps.rescale(scale);
    this.#viewport?.draw();
  }

  hideResult(): void {
    this.#result = undefined;
    if (!this.#isOfBodies) this.#showArrow();
    this.#maps.hide();
    this.#viewport?.draw();
  }

  /**
   * Colours the faces that a comparison found changed and greys the others, of one model or of both;
   * without a comparison, ends that.
   */
  showFaces(diff: DiffResult | undefined, side?: Side): void {
    this.#changed.show(diff, side);
    if (diff === undefined) this.#showArrow();
    this.#viewport?.draw();
  }

  /** Colours faces by classes of any kind, and greys the others; without any, ends that. */
  classify(classes: Sides<FaceClass[]>): void {
    this.models.classify(classes);
    this.#viewport?.draw();
  }

  /** Zooms to one face of the comparison shown and greys all others; without one, shows all again. */
  selectFace(change: Change | undefined): void {
    const around = this.#changed.select(change);
    if (around === undefined) this.#viewport?.draw();
    else this.#approach(around);
  }

  /** The arrow of the result, in the direction in which the distance is attained. */
  #showArrow(): void {
    const isApart = this.models.explosion.part > 0;
    if (this.#result === undefined || isApart || agrees(this.#result)) {
      this.#arrow.hide();
      return;
    }
    const { from, to, texts } = arrowOf(this.#result);
    this.#arrow.show(from, to, texts, this.models.center);
  }
}
