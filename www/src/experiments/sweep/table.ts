// The results as CSV, with the columns of the command line's experiments.
import { columns } from "../../../../examples/experiments/sweep.json";
import type { Curve, SweepPoint } from "./sweepPoint.ts";

/** Returns the table in the format of RFC 4180. No cell needs quotes: none has a comma, a quote or a line end. */
export function csv(curves: readonly Curve[]): string {
  const rows = curves.flatMap(({ method, points }) =>
    points.map((point) => row(method.name, point).join(",")),
  );
  return [columns.join(","), ...rows, ""].join("\n");
}

/** Numbers are written with all digits that float64 needs. */
function row(name: string, { position, result, failure }: SweepPoint): (string | number)[] {
  if (result === undefined) return [position, name, ...Array(11).fill(""), failure.code];
  const { computed, lower, upper, seconds, patches } = result;
  const bounds = result.method === "iteration" ? result.bounds : undefined;
  return [
    ...[position, name, computed, lower, upper],
    ...[bounds?.kA ?? "", bounds?.kARigorous ?? "", bounds?.kB ?? ""],
    ...[result.converged ? "yes" : "no", seconds.solve, seconds.prepare],
    ...[result.method === "certified" ? result.cells : "", patches.b, ""],
  ];
}
