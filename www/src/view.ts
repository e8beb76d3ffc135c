// What is seen of the models and a result, as far as there is WebGL.
import type { DistanceResult } from "nurbs-hausdorff";
import { Arrow } from "./arrow.ts";
import { deviationGradient, styled } from "./colors.ts";
import { element } from "./elements.ts";
import { Models } from "./models.ts";
import { distanceText } from "./numbers.ts";
import type { Pose } from "./pose.ts";
import { ProjectionLines } from "./projection-lines.ts";
import { Viewport } from "./viewport.ts";

/** How much is seen around an arrow that is approached, in its lengths, and at least in diagonals. */
const AROUND = 2;
const CLOSEST = 1e-5;

export class View {
  readonly models = new Models({ a: styled("a"), b: styled("b") });
  readonly #arrow = new Arrow(element("label"), styled("accent"));
  readonly #lines = new ProjectionLines();
  readonly #legend = element("legend");
  readonly #viewport: Viewport | undefined;

  /** `withoutWebGl` is told why nothing can be shown. */
  constructor(canvas: HTMLCanvasElement, withoutWebGl: (why: string) => void) {
    element("scale").style.background = deviationGradient;
    try {
      const viewport = new Viewport(canvas);
      viewport.scene.add(this.models.group, this.#arrow.group, this.#lines.lines);
      viewport.onDraw = () =>
        this.#arrow.place(viewport.camera, canvas.clientWidth, canvas.clientHeight);
      this.#viewport = viewport;
    } catch (error) {
      withoutWebGl(error instanceof Error ? error.message : `${error}`);
    }
  }

  fit(): void {
    this.#viewport?.fit(this.models.box);
  }

  approachArrow(): void {
    if (!this.#arrow.group.visible) return;
    const radius = Math.max(AROUND * this.#arrow.length, CLOSEST * this.models.diagonal);
    this.#viewport?.approach(this.#arrow.middle, radius);
  }

  show(pose: Pose, transparent: boolean, triangles: boolean): void {
    this.models.pose(pose);
    this.models.look(transparent, triangles);
    this.#viewport?.draw();
  }

  /** Shows the arrow, and the lines if the result has a field. */
  showResult(result: DistanceResult): void {
    this.#arrow.show(result, this.models.center);
    const field = result.field ?? result.forward?.field;
    this.#legend.hidden = field === undefined;
    if (field === undefined) this.#lines.hide();
    else {
      const largest = this.#lines.show(field, this.models.center);
      element("scale-end").textContent = distanceText(largest, result.diagonal);
    }
    this.#viewport?.draw();
  }

  hideResult(): void {
    this.#arrow.hide();
    this.#lines.hide();
    this.#legend.hidden = true;
    this.#viewport?.draw();
  }
}
