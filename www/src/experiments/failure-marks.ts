// Crosses at the foot of a panel, where methods failed.
import type uPlot from "uplot";
import type { Curve } from "./outcome.ts";

/** Half a cross, and its line, in pixels. */
const HALF = 4;
const LINE = 2;
/** From one method's row to the next, in halves of a cross. */
const ROW = 3;

/** Draws a row of crosses for every method that failed; what was left out did not fail. */
export function markFailures(
  { ctx, bbox, valToPos }: uPlot,
  curves: readonly Curve[],
  colorOf: (method: string) => string,
): void {
  const half = HALF * devicePixelRatio;
  ctx.save();
  ctx.lineWidth = LINE * devicePixelRatio;
  let y = bbox.top + bbox.height;
  for (const { method, outcomes } of curves) {
    const failed = outcomes.filter(({ failure }) => failure && failure.code !== "left-out");
    if (failed.length === 0) continue;
    y -= ROW * half;
    ctx.strokeStyle = colorOf(method.name);
    ctx.beginPath();
    for (const { position } of failed) {
      const x = valToPos(position, "x", true);
      ctx.moveTo(x - half, y - half);
      ctx.lineTo(x + half, y + half);
      ctx.moveTo(x - half, y + half);
      ctx.lineTo(x + half, y - half);
    }
    ctx.stroke();
  }
  ctx.restore();
}
