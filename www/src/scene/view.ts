// The view of the models and a result. Without WebGL it draws nothing.
import type { DistanceResult, Field, Transform } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import { signedText } from "../common/numbers.ts";
import { Arrow } from "./arrow.ts";
import { cssColor, deviationGradient } from "./colors.ts";
import { largestDistance } from "./deviation.ts";
import { Models } from "./models.ts";
import type { Pose } from "./pose.ts";
import { ProjectionLines } from "./projectionLines.ts";
import { Viewport } from "./viewport.ts";

/** The radius of the view around the arrow, in lengths of the arrow, and its minimum, in diagonals. */
const APPROACH_RADIUS = 2;
const MIN_APPROACH_RADIUS = 1e-5;

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
    this.#arrow.show(result, this.models.center);
    this.#hideField();
    const field = (result.forward ?? result).field;
    if (field !== undefined) this.#showField(field, result.diagonal, transform);
    this.#viewport?.draw();
  }

  hideResult(): void {
    this.#arrow.hide();
    this.#hideField();
    this.#viewport?.draw();
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
