// The colour scale as a texture: a new scale recolours everything without touching its geometry.
import { DataTexture, NearestFilter, SRGBColorSpace } from "three";
import type { ColorScale } from "./scale.ts";

/** Colours from one end of the scale to the other. */
const WIDTH = 1024;
/** The rows: deviations with a sign, and without. */
const ROWS = 2;
/** The width of a scale whose inverse float32 holds: those of models without a size are less. */
const LEAST_WIDTH = 2 ** -126;

export class ScaleTexture {
  readonly texture = new DataTexture(new Uint8Array(4 * ROWS * WIDTH), WIDTH, ROWS);

  constructor() {
    this.texture.colorSpace = SRGBColorSpace;
    this.texture.magFilter = NearestFilter;
    this.texture.minFilter = NearestFilter;
  }

  /** Shows a scale; texture coordinates are deviations, and rows as `MapDisplay` has them. */
  show(scale: ColorScale): void {
    const data = this.texture.image.data as Uint8Array;
    const width = scale.high - scale.low;
    for (let row = 0; row < ROWS; row++) {
      for (let column = 0; column < WIDTH; column++) {
        const deviation = scale.low + ((column + 0.5) / WIDTH) * width;
        const hex = scale.color(deviation, row === 0).getHex();
        data.set([hex >> 16, (hex >> 8) & 255, hex & 255, 255], 4 * (row * WIDTH + column));
      }
    }
    this.texture.repeat.set(width > LEAST_WIDTH ? 1 / width : 0, 1);
    this.texture.offset.set(-scale.low / width, 0);
    this.texture.needsUpdate = true;
  }
}
