// The page's colours, which its style sheet names, and the scale of the deviation.
import { Color } from "three";

/** A colour of the style sheet. */
export const styled = (name: "a" | "b" | "accent"): string =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** From far behind B's normals to far before them: ColorBrewer's "RdBu", told apart by the colour-blind too. */
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

/** Where B has no normal, the deviation has no sign. */
const UNSIGNED = new Color("#808890");

/** The colour of a signed deviation between -1 and 1; it is not to be changed. */
export function deviationColor(part: number): Color {
  if (Number.isNaN(part)) return UNSIGNED;
  const at = (Math.min(1, Math.max(-1, part)) + 1) * 0.5 * (SCALE.length - 1);
  const step = Math.min(SCALE.length - 2, Math.floor(at));
  const [from = UNSIGNED, to = UNSIGNED] = [SCALE[step], SCALE[step + 1]];
  return new Color().lerpColors(from, to, at - step);
}

/** The scale as CSS paints it. */
export const deviationGradient = `linear-gradient(to right, ${SCALE.map((color) => color.getStyle()).join(", ")})`;
