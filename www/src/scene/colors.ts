// The colours of the style sheet, and the colour scale of the deviation.
import { Color } from "three";

/** Returns a colour of the style sheet. */
export const cssColor = (name: "a" | "b" | "accent"): string =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** From negative to positive deviation: ColorBrewer's diverging scale RdBu, which is safe for colour-blind readers. */
const SCALE = [
  "#2166ac",
  "#4393c3",
  "#92c5de",
  "#d1e5f0",
  "#f7f7f7",
  "#fddbc7",
  "#f4a582",
  "#d6604d",
  "#b2182b",
].map((color) => new Color(color));

/** For points whose closest point on B has no normal, so that the deviation has no sign. */
const UNSIGNED = new Color("#808890");

/** Returns the colour of a signed deviation relative to the largest one, in [-1, 1], or NaN for one without a sign. */
export function deviationColor(relative: number): Color {
  if (Number.isNaN(relative)) return UNSIGNED;
  const at = (Math.min(1, Math.max(-1, relative)) + 1) * 0.5 * (SCALE.length - 1);
  const step = Math.min(SCALE.length - 2, Math.floor(at));
  const [from = UNSIGNED, to = UNSIGNED] = [SCALE[step], SCALE[step + 1]];
  return new Color().lerpColors(from, to, at - step);
}

/** The scale as a CSS gradient. */
export const deviationGradient = `linear-gradient(to right, ${SCALE.map((color) => color.getStyle()).join(", ")})`;
