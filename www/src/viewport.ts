// The three-dimensional view: camera, light, and drawing when something changed.
import {
  ACESFilmicToneMapping,
  AmbientLight,
  DirectionalLight,
  PerspectiveCamera,
  PMREMGenerator,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

/** The direction that the camera looks from at first. */
const VIEW = new Vector3(0.75, -1.25, 0.8).normalize();
const FIELD_OF_VIEW = 32;
/** Room around the models. */
const MARGIN = 1.12;

export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW);
  /** Called before every drawing. */
  onDraw: () => void = () => {};
  readonly #renderer: WebGLRenderer;
  readonly #controls: OrbitControls;
  #wanted = false;

  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.toneMapping = ACESFilmicToneMapping;
    const environment = new PMREMGenerator(this.#renderer).fromScene(new RoomEnvironment(), 0.04);
    this.scene.environment = environment.texture;
    this.scene.environmentIntensity = 0.55;
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 1.5);
    sun.position.set(0.4, -0.6, 1);
    this.camera.add(sun);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 0.25));
    this.#controls = new OrbitControls(this.camera, canvas);
    this.#controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  /** The whole sphere into view, from the first direction. */
  fit(radius: number): void {
    const aspect = Math.min(1, this.camera.aspect);
    const distance = (MARGIN * radius) / Math.sin((FIELD_OF_VIEW * Math.PI) / 360) / aspect;
    this.camera.position.copy(VIEW).multiplyScalar(distance);
    this.camera.near = distance / 1000;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.#controls.target.set(0, 0, 0);
    this.#controls.update();
    this.draw();
  }

  /** Draws with the next frame. */
  draw(): void {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => {
      this.#wanted = false;
      this.#renderer.render(this.scene, this.camera);
      this.onDraw();
    });
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
