// Crosses at the bottom of a panel that mark failures.
import type uPlot from "uplot";
import type { Curve } from "../sweep/sweepPoint.ts";

/** Half the size of a cross, and its line width, in pixels. */
const HALF = 4;
const LINE = 2;
/** The distance between the rows of two methods, in half sizes. */
const ROW = 3;

/** Draws a row of crosses for every method that failed; runs that were left out are not failures. */
export function markFailures(
  { ctx, bbox, valToPos }: uPlot,
  curves: readonly Curve[],
  colorOf: (method: string) => string,
): void {
  const half = HALF * devicePixelRatio;
  ctx.save();
  ctx.lineWidth = LINE * devicePixelRatio;
  let y = bbox.top + bbox.height;
  for (const { method, points } of curves) {
    const failed = points.filter(({ failure }) => failure && failure.code !== "left-out");
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
