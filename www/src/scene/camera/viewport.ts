// The three-dimensional viewport: camera, light, and drawing on demand.
import {
  type Box3,
  type Camera,
  type Intersection,
  NeutralToneMapping,
  type Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { nextTask } from "../../common/nextTask.ts";
import { POINT_SIZE } from "../material.ts";
import { fitDistance } from "./fit.ts";
import { followFlat } from "./flat.ts";
import { around, isSame, NOWHERE, type Part, partOf } from "./free.ts";
import { light } from "./light.ts";
import { settle } from "./settle.ts";
import { STANDARD_VIEWS } from "./standardViews.ts";
import { Way } from "./way.ts";
import { BESIDE, renderWiped, type Wipe } from "./wipe.ts";

const FIELD_OF_VIEW = 32;
/** The tangent of half the field of view. */
const TANGENT = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
/** The sine of half the field of view. */
const SINE = Math.sin((FIELD_OF_VIEW * Math.PI) / 360);
/** The cosine of the largest angle from a surface's normal from which it is looked at. */
const MIN_FACING = 0.4;
/** The part of a normal in a direction that was turned to it, beside a unit vector along the surface. */
const TURNED = 1.2;
/** The clipping planes, in units of the distance from the camera to its target. */
const NEAR = 1e-3;
const FAR = 50;
/** Device pixels per CSS pixel; more cost time without a visible gain. */
const MAX_PIXEL_RATIO = 2;
const CONTEXT = { antialias: true, alpha: true, stencil: true } as const;
/** Milliseconds after which a drawing no longer waits for its shaders. */
const MAX_COMPILATION = 3000;

/** A box that fills the view, seen from a direction. */
interface Fitted {
  box: Box3;
  direction: Vector3;
}

export class Viewport {
  readonly scene = new Scene();
  readonly controls: OrbitControls;
  /** Whether a tool takes the clicks. The view then makes room for elements that grow, and not for those that shrink. */
  isPicked = false;
  /** Called before every drawing, after the camera was updated. */
  onDraw: () => void = () => {};
  /** Called when the browser takes the means of drawing away, and when it gives them back. */
  onContext: (isThere: boolean) => void = () => {};
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  /** The camera that the controls move; the orthographic one follows it. */
  readonly #perspective = new PerspectiveCamera(FIELD_OF_VIEW);
  readonly #orthographic = new OrthographicCamera();
  #camera: PerspectiveCamera | OrthographicCamera = this.#perspective;
  #sized = false;
  #drawRequested = false;
  #compiling = 0;
  /** The part of the view, from the left, that shows one model; undefined where all is shown. */
  #wipe: Wipe | undefined;
  readonly #way: Way;
  /** The view's width and height, in CSS pixels. */
  #size: readonly [number, number] = [0, 0];
  /** What lies over the view, and where. */
  readonly #over: { element: HTMLElement; part: Part }[] = [];
  /** What was fitted to the view, until the camera is moved elsewhere. */
  #fitted: Fitted | undefined;
  /** What was seen before a place was shown from near. */
  #before: { place: number[]; fitted: Fitted | undefined } | undefined;

  /**
   * Opens a viewport in some short tasks: the context, the renderer's state.
   *
   * @throws {Error} without WebGL.
   */
  static async open(canvas: HTMLCanvasElement): Promise<Viewport> {
    // three.js' types name the first version of WebGL, whose interface the second has.
    const context = canvas.getContext("webgl2", CONTEXT) as WebGLRenderingContext | null;
    await nextTask();
    // Without a context three.js throws the reason.
    const given = context === null ? {} : { context };
    const renderer = new WebGLRenderer({ canvas, ...given, ...CONTEXT });
    await nextTask();
    return new Viewport(canvas, renderer);
  }

  private constructor(canvas: HTMLCanvasElement, renderer: WebGLRenderer) {
    this.#canvas = canvas;
    this.#renderer = renderer;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, MAX_PIXEL_RATIO));
    this.#renderer.toneMapping = NeutralToneMapping;
    this.#renderer.localClippingEnabled = true;
    // The check waits for the driver's compiler; the shaders are three.js's own.
    this.#renderer.debug.checkShaderErrors = import.meta.env.DEV;
    this.#perspective.up.set(0, 0, 1);
    light(this.scene, this.#perspective);
    this.controls = new OrbitControls(this.#perspective, canvas);
    this.controls.listenToKeyEvents(canvas);
    this.#way = new Way({
      ...{ camera: this.#perspective, target: this.controls.target },
      onStep: () => {
        this.controls.update();
        this.draw();
      },
    });
    this.controls.addEventListener("change", () => this.draw());
    // The user's hand ends the camera's own way.
    this.controls.addEventListener("start", () => {
      this.#way.end();
      this.#fitted = undefined;
    });
    canvas.addEventListener("webglcontextlost", () => this.onContext(false));
    canvas.addEventListener("webglcontextrestored", () => {
      this.onContext(true);
      this.draw();
    });
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  /** Shows models where none of these elements lies over them, as far as there is room; the first are heeded first. */
  keepClear(...elements: HTMLElement[]): void {
    const observer = new ResizeObserver(() => {
      if (this.#clear() && this.#sized) this.#arrange();
    });
    for (const element of elements) {
      this.#over.push({ element, part: NOWHERE });
      observer.observe(element, { box: "border-box" });
    }
  }

  /** What lies over the view, in CSS pixels. */
  get over(): readonly Part[] {
    return this.#over.map(({ part }) => part);
  }

  /** Heeds where the elements over the view are now; returns whether that is elsewhere than before. */
  #clear(): boolean {
    const before = this.over;
    for (const over of this.#over) {
      const part = partOf(over.element);
      over.part = this.isPicked ? around(over.part, part) : part;
    }
    return this.#over.some(({ part }, index) => !isSame(part, before[index] ?? NOWHERE));
  }

  /** Moves the models to where nothing lies over them; what filled the view fills it there. */
  #arrange(): void {
    const [width, height] = this.#size;
    // A place is in the middle of what is free.
    this.#settle((free) => -Math.min(free[0] * width, free[1] * height));
    if (this.#fitted !== undefined) this.fit(this.#fitted.box, this.#fitted.direction, true);
    this.draw();
  }

  /** Whether the corners of a box are within the view. */
  holds(box: Box3): boolean {
    this.#updateCameras();
    const [width, height] = this.#size;
    return [0, 1, 2, 3, 4, 5, 6, 7].every((corner) => {
      const [x, y, z] = [1, 2, 4].map((bit) => (corner & bit) !== 0);
      const { min, max } = box;
      const point = new Vector3((x ? max : min).x, (y ? max : min).y, (z ? max : min).z);
      const at = this.project(point);
      return at !== undefined && at[0] >= 0 && at[0] <= width && at[1] >= 0 && at[1] <= height;
    });
  }

  /** Draws one model left of a fraction of the view and the other one right of it. */
  set wipe(wipe: Wipe | undefined) {
    const isOther = (wipe?.isBeside ?? false) !== this.#isBeside;
    this.#wipe = wipe;
    if (isOther && this.#sized) this.#arrange();
    this.draw();
  }

  get #isBeside(): boolean {
    return this.#wipe?.isBeside ?? false;
  }

  /** The side that alone is shown at a place of the window; undefined where both are. */
  sideAt(clientX: number): "a" | "b" | undefined {
    if (this.#wipe === undefined) return undefined;
    const { left, width } = this.#canvas.getBoundingClientRect();
    return clientX - left < this.#wipe.fraction * width ? "a" : "b";
  }

  /** Where the camera and its target are, to show the same view again. */
  get place(): number[] {
    const { position } = this.#perspective;
    return [...position.toArray(), ...this.controls.target.toArray()];
  }

  set place([x = 0, y = 0, z = 0, ...target]: number[]) {
    if (![x, y, z, ...target].every(Number.isFinite)) return;
    if (!this.#sized) this.#resize();
    this.#way.end();
    this.#fitted = undefined;
    this.#perspective.position.set(x, y, z);
    this.controls.target.set(target[0] ?? 0, target[1] ?? 0, target[2] ?? 0);
    this.controls.update();
    this.draw();
  }

  /** The camera that is drawn with. */
  get camera(): Camera {
    return this.#camera;
  }

  set orthographic(orthographic: boolean) {
    this.#camera = orthographic ? this.#orthographic : this.#perspective;
    this.draw();
  }

  /** The size of a pixel at a point of the scene. */
  pixelAt(point: Vector3): number {
    const { position } = this.#perspective;
    const at = this.#camera === this.#perspective ? point : this.controls.target;
    return this.#pixelAtDistance(position.distanceTo(at));
  }

  #pixelAtDistance(distance: number): number {
    const pixel = (2 * distance * TANGENT) / this.#canvas.clientHeight;
    return this.#isBeside ? pixel / BESIDE : pixel;
  }

  /**
   * The position of a point of the scene in pixels of the canvas; undefined behind the camera. Side by
   * side, that of the side's part.
   */
  project(point: Vector3, side: "a" | "b" = "a"): [x: number, y: number] | undefined {
    const { x, y, z } = point.clone().project(this.#camera);
    const { clientWidth, clientHeight } = this.#canvas;
    if (Math.abs(z) > 1) return undefined;
    const width = this.#isBeside ? clientWidth / 2 : clientWidth;
    const left = this.#isBeside && side === "b" ? width : 0;
    return [left + (0.5 + 0.5 * x) * width, (0.5 - 0.5 * y) * clientHeight];
  }

  /** The middle of the part of the view that is free, in pixels of the window: what the camera looks at is there. */
  get middle(): [clientX: number, clientY: number] {
    this.#updateCameras();
    const { left, top, width, height } = this.#canvas.getBoundingClientRect();
    const [x, y] = this.project(this.controls.target) ?? [width / 2, height / 2];
    return [left + x, top + y];
  }

  /**
   * Returns what a ray through a point of the window hits, the nearest first,
   * with the camera and the objects where the next drawing shows them: while
   * shaders are compiled, the last drawing may be of other models.
   */
  hits(clientX: number, clientY: number, objects: Object3D[]): Intersection[] {
    this.#updateCameras();
    this.scene.updateMatrixWorld();
    const { left, top, width, height } = this.#canvas.getBoundingClientRect();
    const own = this.#isBeside ? width / 2 : width;
    const from = this.#isBeside && this.sideAt(clientX) === "b" ? own : 0;
    const at = new Vector2(
      (2 * (clientX - left - from)) / own - 1,
      1 - (2 * (clientY - top)) / height,
    );
    const ray = new Raycaster();
    ray.setFromCamera(at, this.#camera);
    // The radius of points, from the eye's perspective where they are 1 away.
    const isFlat = this.#camera === this.#orthographic;
    const distance = isFlat ? this.#perspective.position.distanceTo(this.controls.target) : 1;
    ray.params.Points.threshold = (POINT_SIZE / 2) * this.#pixelAtDistance(distance);
    return ray.intersectObjects(objects, false);
  }

  /** Shows the whole box from a direction, `atOnce` without a way to it: for models that are new. */
  fit(box: Box3, direction: Vector3 = STANDARD_VIEWS.oblique, atOnce = false): void {
    if (box.isEmpty()) return;
    // Later sizes are observed: reading one here would lay out the page at once.
    if (!this.#sized) this.#resize();
    const distance = this.#settle((free) => fitDistance(this.#perspective, direction, box, free));
    this.#way.to({ target: box.getCenter(new Vector3()), direction, distance }, atOnce);
    this.#fitted = { box: box.clone(), direction: direction.clone() };
    this.#before = undefined;
  }

  /** Shows the whole box, from where it was seen, if all was shown before; a place from near stays. */
  refit(box: Box3): void {
    if (this.#fitted !== undefined) this.fit(box, this.#fitted.direction, true);
  }

  /** Shows what was seen before a place was shown from near. */
  back(): void {
    if (this.#before === undefined) return;
    const { place, fitted } = this.#before;
    this.#before = undefined;
    if (fitted !== undefined) {
      this.fit(fitted.box, fitted.direction);
      return;
    }
    const eye = new Vector3(...place.slice(0, 3));
    const target = new Vector3(...place.slice(3));
    const direction = eye.sub(target);
    const distance = direction.length();
    this.#way.to({ target, direction: direction.normalize(), distance }, false);
  }

  /**
   * Shows models in the free part of the view in which they are seen from the least distance, by its
   * width and height as parts of the view's; returns that distance.
   */
  #settle(distanceIn: (free: [width: number, height: number]) => number): number {
    const shown = { size: this.#size, over: this.over, isBeside: this.#isBeside };
    return settle([this.#perspective, this.#orthographic], shown, distanceIn);
  }

  /** Shows a sphere at once, from a side from which a surface with this normal is seen. */
  approachAtOnce(center: Vector3, radius: number, normal: Vector3): void {
    const eye = center.clone().addScaledVector(this.#facing(normal), radius / SINE);
    this.place = [...eye.toArray(), ...center.toArray()];
  }

  /** Shows a sphere, from the current direction, or where a surface has this normal from its side. */
  approach(center: Vector3, radius: number, normal?: Vector3): void {
    const direction = normal === undefined ? this.#direction() : this.#facing(normal);
    this.#before ??= { place: this.place, fitted: this.#fitted };
    this.#fitted = undefined;
    this.#arrange();
    this.#way.to({ target: center, direction, distance: radius / SINE }, false);
  }

  /** The point that the camera looks at, and the direction from there to it. */
  get seen(): { point: Vector3; normal: Vector3 } {
    return { point: this.controls.target.clone(), normal: this.#direction() };
  }

  /** The direction from the target to the camera. */
  #direction(): Vector3 {
    const direction = this.#perspective.position.clone().sub(this.controls.target);
    return direction.lengthSq() > 0 ? direction.normalize() : STANDARD_VIEWS.oblique.clone();
  }

  /** The current direction, turned as far as a surface with this normal requires to be seen. */
  #facing(normal: Vector3): Vector3 {
    const direction = this.#direction();
    if (normal.dot(direction) >= MIN_FACING) return direction;
    return direction.addScaledVector(normal, TURNED - normal.dot(direction)).normalize();
  }

  /**
   * Compiles the shaders of new objects and draws when that is done, so that
   * the page does not wait for the driver's compiler.
   */
  async compile(): Promise<void> {
    this.#compiling += 1;
    this.#canvas.dataset.state = "pending";
    // How the objects are shown, which is set in the same task, decides on their shaders.
    await Promise.resolve();
    const compiled = this.#renderer.compileAsync(this.scene, this.#camera);
    const late = new Promise((resolve) => setTimeout(resolve, MAX_COMPILATION));
    await Promise.race([compiled, late]);
    this.#compiling -= 1;
    this.draw();
  }

  /** Requests a drawing in the next frame; until then the canvas says that one is pending. */
  draw(): void {
    this.#canvas.dataset.state = "pending";
    if (this.#drawRequested || this.#compiling > 0) return;
    this.#drawRequested = true;
    requestAnimationFrame(() => {
      this.#drawRequested = false;
      this.render();
      if (this.#compiling === 0) this.#canvas.dataset.state = "drawn";
    });
  }

  /** Draws now, so that the canvas can be read in the same task. */
  render(): void {
    this.#updateCameras();
    this.onDraw();
    const [scene, camera] = [this.scene, this.#camera];
    if (this.#wipe === undefined) this.#renderer.render(scene, camera);
    else {
      const { clientWidth, clientHeight } = this.#canvas;
      renderWiped(this.#renderer, { scene, camera }, [clientWidth, clientHeight], this.#wipe);
    }
  }

  #updateCameras(): void {
    const [eye, flat] = [this.#perspective, this.#orthographic];
    const distance = eye.position.distanceTo(this.controls.target);
    eye.near = NEAR * distance;
    eye.far = FAR * distance;
    eye.updateProjectionMatrix();
    eye.updateMatrixWorld();
    followFlat(flat, eye, distance * TANGENT);
  }

  #resize(): void {
    this.#sized = true;
    const { clientWidth, clientHeight } = this.#canvas;
    // Nothing fits a view without a size, from any distance.
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.#size = [clientWidth, clientHeight];
    this.#clear();
    this.#arrange();
  }
}
