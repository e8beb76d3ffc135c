// The three-dimensional view: camera, light, and drawing when something changed.
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
import { fitted } from "./fit.ts";

/** The direction that the camera looks from at first. */
const VIEW = new Vector3(0.75, -1.25, 0.8).normalize();
const FIELD_OF_VIEW = 32;
/** Clipping planes in distances of the camera from what it looks at. */
const NEAR = 1e-3;
const FAR = 50;
/** Sharper than two pixels a point is not seen, but paid for. */
const MOST_PIXELS = 2;

export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW);
  /** Called before every drawing, the camera being where it will be. */
  onDraw: () => void = () => {};
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #controls: OrbitControls;
  #wanted = false;

  /** Throws where there is no WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, MOST_PIXELS));
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

  /** The whole box into view, from the first direction. */
  fit(box: Box3): void {
    this.#resize();
    this.#controls.target.copy(box.getCenter(new Vector3()));
    this.#look(VIEW, fitted(this.camera, VIEW, box));
  }

  /** A sphere into view, from the direction that the camera looks from now. */
  approach(center: Vector3, radius: number): void {
    const direction = this.camera.position.clone().sub(this.#controls.target).normalize();
    this.#controls.target.copy(center);
    this.#look(direction, radius / Math.sin((FIELD_OF_VIEW * Math.PI) / 360));
  }

  /** Draws with the next frame. */
  draw(): void {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => {
      this.#wanted = false;
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
