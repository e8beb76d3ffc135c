// The colour scale of the deviation.
import { Color } from "three";

/** From negative to positive: ColorBrewer's diverging scale RdBu, which is safe for colour-blind readers. */
const DIVERGING = colors([
  ...["#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7"],
  ...["#fddbc7", "#f4a582", "#d6604d", "#b2182b"],
]);

/** From negative to positive, as metrologists expect: Tol's discrete rainbow, whose steps are distinct for colour-blind readers. */
const RAINBOW = colors([
  ...["#1965b0", "#5289c7", "#7bafde", "#4eb265", "#90c987"],
  ...["#cae0ab", "#f7f056", "#f6c141", "#f1932d", "#e8601c", "#dc050c"],
]);

/** From zero to the largest distance: ColorBrewer's scale YlOrRd. */
const SEQUENTIAL = colors(["#fffff0", "#ffeda0", "#feb24c", "#fc4e2a", "#b10026", "#67001f"]);

/** For points whose closest point on B has no normal, so that the deviation has no sign. */
const UNSIGNED = new Color("#808890");
/** For deviations within the limit, and for those that rounding may have made. */
const WITHIN = new Color("#79b98a");
const ROUNDING = new Color("#f2f3f4");
/** For deviations that the user did not ask to see. */
const UNFOCUSED = new Color("#c3cad1");

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

export class ColorScale {
  /** The ends of the scale: on one side of 0 if all deviations are. */
  readonly low: number;
  readonly high: number;
  readonly #floor: number;
  readonly #options: ScaleOptions;

  constructor({ lowest, highest, largest, floor }: Extent, options: ScaleOptions) {
    const end = options.range ?? (Math.max(largest, floor) || Number.MIN_VALUE);
    const none = highest <= floor && lowest >= -floor;
    const below = options.rangeBelow ?? end;
    this.low = options.absolute || (lowest >= -floor && !none) ? 0 : -below;
    this.high = !options.absolute && highest <= floor && !none ? 0 : end;
    this.#floor = floor;
    this.#options = options;
  }

  /** Returns the colour of a signed deviation; `signed` states whether its sign is known. */
  color(deviation: number, signed = true): Color {
    const size = Math.abs(deviation);
    const { absolute, allowed, focus, map } = this.#options;
    const shown = absolute ? size : deviation;
    if (focus !== undefined && (shown < focus[0] || shown > focus[1])) return UNFOCUSED;
    // Allowed deviations have one colour on all parts, also where rounding cannot be told from 0.
    if (allowed !== undefined && isWithin(deviation, signed, allowed)) return WITHIN;
    if (size <= this.#floor) return ROUNDING;
    if (!signed && !absolute) return UNSIGNED;
    const value = stepped(shown, this.low, this.high, this.#steps);
    // Each side of 0 has all colours of its half, whichever way the scale reaches farther.
    const part = value < 0 ? value / -this.low : value / (this.high || 1);
    if (map === "rainbow") return at(RAINBOW, absolute ? part : 0.5 + 0.5 * part);
    return absolute ? at(SEQUENTIAL, part) : at(DIVERGING, 0.5 + 0.5 * part);
  }

  /** A rainbow is in steps always: its order is not that of brightness. */
  get #steps(): number {
    const { map, steps } = this.#options;
    return map === "rainbow" && steps === 0 ? RAINBOW.length : steps;
  }

  /** The scale from low to high as stops, each from and to a fraction of it. */
  stops(count: number): Color[] {
    return Array.from({ length: count }, (_, index) =>
      this.color(this.low + ((index + 0.5) / count) * (this.high - this.low)),
    );
  }
}

/** Whether a deviation is allowed; one without a sign, if it is with either. */
function isWithin(deviation: number, signed: boolean, { above, below }: Allowed): boolean {
  if (!signed) return Math.abs(deviation) <= Math.min(above, below);
  return deviation <= above && deviation >= -below;
}

/** Returns the middle of the step that contains the value. */
function stepped(value: number, low: number, high: number, steps: number): number {
  const inside = Math.min(high, Math.max(low, value));
  if (steps === 0) return inside;
  const step = (high - low) / steps;
  const index = Math.min(steps - 1, Math.floor((inside - low) / step));
  // The outermost steps have the colours of the ends.
  return steps === 1 ? inside : low + (index / (steps - 1)) * (high - low);
}

function at(all: Color[], fraction: number): Color {
  const place = Math.min(1, Math.max(0, fraction)) * (all.length - 1);
  const step = Math.min(all.length - 2, Math.floor(place));
  const [from = UNSIGNED, to = UNSIGNED] = [all[step], all[step + 1]];
  return new Color().lerpColors(from, to, place - step);
}

function colors(names: string[]): Color[] {
  return names.map((name) => new Color(name));
}
