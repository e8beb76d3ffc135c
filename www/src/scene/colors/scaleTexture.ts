// The colour scale as a texture: a new scale recolours everything without touching its geometry.
import { DataTexture, NearestFilter, SRGBColorSpace } from "three";
import type { ColorScale } from "./scale.ts";

/** Colours from one end of the scale to the other. */
const WIDTH = 1024;
/** The rows: deviations with a sign, and without. */
const ROWS = 2;

export class ScaleTexture {
  readonly texture = new DataTexture(new Uint8Array(4 * ROWS * WIDTH), WIDTH, ROWS);

  constructor() {
    this.texture.colorSpace = SRGBColorSpace;
    this.texture.magFilter = NearestFilter;
    this.texture.minFilter = NearestFilter;
  }

  /** Shows a scale for deviations that are given in units of `unit`. */
  show(scale: ColorScale, unit: number): void {
    const data = this.texture.image.data as Uint8Array;
    const width = scale.high - scale.low;
    for (let row = 0; row < ROWS; row++) {
      for (let column = 0; column < WIDTH; column++) {
        const deviation = scale.low + ((column + 0.5) / WIDTH) * width;
        const hex = scale.color(deviation, row === 0).getHex();
        data.set([hex >> 16, (hex >> 8) & 255, hex & 255, 255], 4 * (row * WIDTH + column));
      }
    }
    this.texture.repeat.set(unit / width, 1);
    this.texture.offset.set(-scale.low / width, 0);
    this.texture.needsUpdate = true;
  }
}

/** The texture coordinates of a deviation in units of the texture's `show`. */
export function textureCoordinates(signed: number, distance: number): [number, number] {
  return Number.isNaN(signed) ? [distance, 0.75] : [signed, 0.25];
}
