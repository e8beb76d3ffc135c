// The colour scale of the deviation: that of the reports, in Rust.
import { Color } from "three";
import base64 from "../../../wasm/inlined-colors.js";
import { DeviationScale, initSync } from "../../../wasm/nurbs_hausdorff_colors.js";

// Some kilobytes, which the main thread has from the start: it colours while the worker measures.
initSync({ module: Uint8Array.from(atob(base64), (character) => character.charCodeAt(0)) });

/** The numbers of the deviation that a scale is for. */
export interface Extent {
  lowest: number;
  highest: number;
  /** The largest distance, of samples with and without a sign. */
  largest: number;
  /** Deviations up to this cannot be distinguished from 0. */
  floor: number;
}

/** The colours: from blue over white to red, or a rainbow in steps. */
export type ScaleMap = "diverging" | "rainbow";

/** What deviations are allowed to be: up to `above`, and down to −`below`. */
export interface Allowed {
  above: number;
  below: number;
}

/** The choices of the user. */
export interface ScaleOptions {
  map: ScaleMap;
  /** Whether distances are shown instead of signed deviations. */
  absolute: boolean;
  /** The upper end of the scale; undefined for the largest distance. */
  range: number | undefined;
  /** How far the scale reaches below 0; undefined for as far as above. */
  rangeBelow?: number | undefined;
  /** The number of steps of one colour each; 0 for a continuous scale. */
  steps: number;
  /** Deviations within this are of one colour. */
  allowed: Allowed | undefined;
  /** The only deviations that keep their colours. */
  focus?: readonly [from: number, to: number] | undefined;
}

/** A place of the scale that has a label. */
export interface Mark {
  value: number;
  kind: "end" | "zero" | "allowed" | "least" | "most";
}

export class ColorScale {
  /** The ends of the scale: on one side of 0 if all deviations are. */
  readonly low: number;
  readonly high: number;
  readonly #scale: DeviationScale;

  constructor({ lowest, highest, largest, floor }: Extent, options: ScaleOptions) {
    const { map, absolute, range, rangeBelow, steps, allowed, focus } = options;
    this.#scale = new DeviationScale(
      ...([lowest, highest, largest, floor] as const),
      map === "rainbow",
      absolute,
      steps,
      range,
      rangeBelow,
      limits(allowed),
      focus && Float64Array.from(focus),
    );
    this.low = this.#scale.low;
    this.high = this.#scale.high;
  }

  /** Returns the colour of a signed deviation; `signed` states whether its sign is known. */
  color(deviation: number, signed = true): Color {
    return new Color(this.#scale.color(deviation, signed));
  }

  /** The scale from low to high as stops, each from and to a fraction of it. */
  stops(count: number): Color[] {
    return Array.from(this.#scale.stops(count), (color) => new Color(color));
  }

  /**
   * The places of labels, the important ones first, without those nearer to one than `leastGap` of the scale: the
   * ends, what is allowed, whether or not it has a colour, what was found, and 0.
   */
  marks(leastGap: number, allowed: Allowed | undefined): Mark[] {
    const ticks = this.#scale.ticks(leastGap, limits(allowed));
    return ticks.map(({ value, kind }) => ({ value, kind }));
  }
}

const limits = (allowed: Allowed | undefined): Float64Array | undefined =>
  allowed && Float64Array.of(allowed.above, allowed.below);
