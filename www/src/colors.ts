// The page's colours, which its style sheet names, and the scale of the deviation.
import { Color } from "three";

/** A colour of the style sheet. */
export const styled = (name: "a" | "b" | "accent"): string =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** From no deviation to the largest: steps of "plasma", told apart by the colour-blind too. */
const SCALE = ["#2a0593", "#7e03a8", "#cc4778", "#f89540"].map((color) => new Color(color));

/** The colour of a deviation between 0 and 1. */
export function deviationColor(part: number): Color {
  const at = Math.min(1, Math.max(0, part)) * (SCALE.length - 1);
  const step = Math.min(SCALE.length - 2, Math.floor(at));
  const [from, to] = [SCALE[step], SCALE[step + 1]];
  return new Color().lerpColors(from ?? new Color(), to ?? new Color(), at - step);
}

/** The scale as CSS paints it. */
export const deviationGradient = `linear-gradient(to right, ${SCALE.map((color) => color.getStyle()).join(", ")})`;
