// The measurement of the sheet, frame after frame, in the package's worker.
import type { DistanceResult, Hausdorff, NurbsModel, Tessellation } from "nurbs-hausdorff/worker";
import type { Settings } from "./settings.ts";
import { sheet, wave } from "./sheet.ts";

/** The wave's speed, in radians a second. */
const SPEED = 1.5;
/** The largest deviation of the triangles that are drawn, in units of the part's radius. */
const DRAWN_TOLERANCE = 0.01;

/** One result, and the picture of its sheet. */
export interface Frame {
  result: DistanceResult;
  triangles: Tessellation;
  /** The angle of the wave. */
  angle: number;
  /** From the new control points to the result, in milliseconds. */
  milliseconds: number;
}

export class Frames {
  readonly #hausdorff: Hausdorff;
  readonly #sheet: NurbsModel;
  readonly #part: NurbsModel;
  readonly #settings: Settings;
  #stopped = false;

  private constructor(
    hausdorff: Hausdorff,
    sheet: NurbsModel,
    part: NurbsModel,
    settings: Settings,
  ) {
    this.#hausdorff = hausdorff;
    this.#sheet = sheet;
    this.#part = part;
    this.#settings = settings;
  }

  static async create(hausdorff: Hausdorff, settings: Settings): Promise<Frames> {
    const part = await hausdorff.shape(settings.part);
    const moving = await hausdorff.model([sheet(settings.size)]);
    return new Frames(hausdorff, moving, part, settings);
  }

  /** The triangles of the part. */
  part(): Promise<Tessellation> {
    return this.#part.tessellate({ tolerance: DRAWN_TOLERANCE });
  }

  /** Measures frames until `stop`, from this angle; resolves to the last angle. */
  async run(angle: number, onFrame: (frame: Frame) => void): Promise<number> {
    const { size, method, relativeTolerance } = this.#settings;
    let last = angle;
    let began = performance.now();
    while (!this.#stopped) {
      const now = performance.now();
      last += (SPEED * (now - began)) / 1000;
      began = now;
      // Requests are answered in turn: the distance is that of the new control points.
      const updated = this.#sheet.update(0, wave(size, last));
      const measured = this.#hausdorff.distance(this.#sheet, this.#part, {
        method,
        relativeTolerance,
      });
      const [, result] = await Promise.all([updated, measured]);
      const milliseconds = performance.now() - now;
      const triangles = await this.#sheet.tessellate({ tolerance: DRAWN_TOLERANCE });
      onFrame({ result, triangles, angle: last, milliseconds });
    }
    return last;
  }

  stop(): void {
    this.#stopped = true;
  }

  dispose(): void {
    this.stop();
    for (const model of [this.#sheet, this.#part]) model.dispose();
  }
}
