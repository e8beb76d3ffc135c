// The deviations in the view: both models in the colours of a scale, and the lines to their feet.
import type { Group, Object3D } from "three";
import type { MapDisplay } from "../../worker/map/display.ts";
import { SIDES, type Sides } from "../../worker/protocol.ts";
import type { ColorScale } from "../colors/scale.ts";
import type { ScaleTexture } from "../colors/scaleTexture.ts";
import type { Models } from "../models.ts";
import { ProjectionLines } from "../overlays/projectionLines.ts";

export class ShownMaps {
  readonly #models: Models;
  readonly #scale: ScaleTexture;
  readonly #lines: Record<"a" | "b", ProjectionLines>;

  constructor(models: Models, scale: ScaleTexture) {
    this.#models = models;
    this.#scale = scale;
    this.#lines = { a: new ProjectionLines(scale.texture), b: new ProjectionLines(scale.texture) };
  }

  /** What is drawn beside the models. */
  get objects(): Object3D[] {
    return SIDES.map((side): Group | Object3D => this.#lines[side].lines);
  }

  /** Shows the deviations of models, as colours, lines or both. */
  show(
    maps: Sides<MapDisplay>,
    scale: ColorScale,
    { deviation, lines }: { deviation: boolean; lines: boolean },
  ): void {
    this.#scale.show(scale);
    this.#models.paint(deviation ? maps : {});
    for (const side of SIDES) {
      const map = maps[side];
      if (lines && map) this.#lines[side].show(map, this.#models.center);
      else this.#lines[side].hide();
    }
  }

  /** Shows the same deviations in the colours of another scale. */
  rescale(scale: ColorScale): void {
    this.#scale.show(scale);
  }

  hide(): void {
    this.#models.paint({});
    for (const lines of Object.values(this.#lines)) lines.hide();
  }
}
