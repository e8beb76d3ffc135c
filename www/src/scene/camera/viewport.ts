// The three-dimensional viewport: camera, light, and drawing on demand.
import {
  AmbientLight,
  type Box3,
  DirectionalLight,
  NeutralToneMapping,
  PerspectiveCamera,
  PMREMGenerator,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { fitDistance } from "./fit.ts";

/** The initial direction from the target to the camera. */
const VIEW = new Vector3(0.75, -1.25, 0.8).normalize();
const FIELD_OF_VIEW = 32;
/** The clipping planes, in units of the distance from the camera to its target. */
const NEAR = 1e-3;
const FAR = 50;
/** Device pixels per CSS pixel; more cost time without a visible gain. */
const MAX_PIXEL_RATIO = 2;

export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW);
  /** Called before every drawing, after the camera was updated. */
  onDraw: () => void = () => {};
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #controls: OrbitControls;
  #drawRequested = false;

  /** @throws {Error} without WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, MAX_PIXEL_RATIO));
    this.#renderer.toneMapping = NeutralToneMapping;
    const environment = new PMREMGenerator(this.#renderer).fromScene(new RoomEnvironment(), 0.04);
    this.scene.environment = environment.texture;
    this.scene.environmentIntensity = 0.6;
    this.camera.up.set(0, 0, 1);
    const key = new DirectionalLight(0xffffff, 1.6);
    key.position.set(0.5, 0.8, 1);
    this.camera.add(key);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 0.25));
    this.#controls = new OrbitControls(this.camera, canvas);
    this.#controls.listenToKeyEvents(canvas);
    this.#controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  /** Shows the whole box, from the initial direction. */
  fit(box: Box3): void {
    this.#resize();
    this.#controls.target.copy(box.getCenter(new Vector3()));
    this.#look(VIEW, fitDistance(this.camera, VIEW, box));
  }

  /** Shows a sphere, from the current direction. */
  approach(center: Vector3, radius: number): void {
    const direction = this.camera.position.clone().sub(this.#controls.target).normalize();
    this.#controls.target.copy(center);
    this.#look(direction, radius / Math.sin((FIELD_OF_VIEW * Math.PI) / 360));
  }

  /** Requests a drawing in the next frame. */
  draw(): void {
    if (this.#drawRequested) return;
    this.#drawRequested = true;
    requestAnimationFrame(() => {
      this.#drawRequested = false;
      const distance = this.camera.position.distanceTo(this.#controls.target);
      this.camera.near = NEAR * distance;
      this.camera.far = FAR * distance;
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();
      this.onDraw();
      this.#renderer.render(this.scene, this.camera);
    });
  }

  #look(direction: Vector3, distance: number): void {
    this.camera.position.copy(this.#controls.target).addScaledVector(direction, distance);
    this.#controls.update();
    this.draw();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
