// What is seen of the models and a result, as far as there is WebGL.
import type { DistanceResult, Field, Transform } from "nurbs-hausdorff";
import { Arrow } from "./arrow.ts";
import { deviationGradient, styled } from "./colors.ts";
import { largestOf } from "./deviation.ts";
import { element } from "./elements.ts";
import { Models } from "./models.ts";
import { signedText } from "./numbers.ts";
import type { Pose } from "./pose.ts";
import { ProjectionLines } from "./projection-lines.ts";
import { Viewport } from "./viewport.ts";

/** How much is seen around an arrow that is approached, in its lengths, and at least in diagonals. */
const AROUND = 2;
const CLOSEST = 1e-5;

/** What the user wants to see besides the models. */
export interface Wanted {
  deviation: boolean;
  lines: boolean;
  triangles: boolean;
}

export class View {
  readonly models = new Models({ a: styled("a"), b: styled("b") });
  readonly #arrow = new Arrow(element("label"), styled("accent"));
  readonly #lines = new ProjectionLines();
  readonly #legend = element("legend");
  readonly #viewport: Viewport | undefined;
  #wanted: Wanted = { deviation: false, lines: false, triangles: false };

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
      element("tools").hidden = true;
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

  show(pose: Pose, wanted: Wanted): void {
    this.#wanted = wanted;
    this.models.pose(pose);
    this.models.look(wanted.lines, wanted.triangles);
    this.#viewport?.draw();
  }

  /** Shows the arrow and, if the result has it, the deviation of A; A stood at `transform`. */
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
    const { deviation, lines } = this.#wanted;
    const largest = largestOf(field);
    if (deviation) this.models.paint(field, largest, transform);
    if (lines) this.#lines.show(field, largest, this.models.center);
    this.#legend.hidden = !(deviation || lines);
    element("scale-low").textContent = signedText(-largest, diagonal);
    element("scale-high").textContent = signedText(largest, diagonal);
  }

  #hideField(): void {
    this.models.unpaint();
    this.#lines.hide();
    this.#legend.hidden = true;
  }
}
