// The outcomes as CSV, with the command line's columns and order.
import { columns } from "../../../examples/experiments/sweep.json";
import type { Curve, Outcome } from "./outcome.ts";

/** RFC 4180 without quotes: no cell of ours holds a comma, a quote or a line end. */
export function csv(curves: readonly Curve[]): string {
  const rows = curves.flatMap(({ method, outcomes }) =>
    outcomes.map((outcome) => row(method.name, outcome).join(",")),
  );
  return [columns.join(","), ...rows, ""].join("\n");
}

/** Numbers are written so that reading them gives the same numbers. */
function row(name: string, { position, result, failure }: Outcome): (string | number)[] {
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
