// Notes on a curve that the plots do not show.
import { axisNumber } from "./charts/axisNumber.ts";
import type { Curve, SweepPoint } from "./sweep/sweepPoint.ts";

/** The largest number of positions that are listed one by one. */
const MAX_LISTED = 3;

/** Returns the failures by code, the reasons for runs left out, and the intervals wider than the tolerance. */
export function notesOf({ method, points }: Curve): string[] {
  const byCode = new Map<string, SweepPoint[]>();
  for (const point of points) {
    const { failure } = point;
    if (failure === undefined) continue;
    byCode.set(failure.code, [...(byCode.get(failure.code) ?? []), point]);
  }
  const failures = [...byCode].map(([code, failed]) => {
    const reason = failed[0]?.failure?.message ?? "";
    if (code === "left-out") return `left out: ${reason}`;
    return `${code} ${positionsText(failed)}; ${failed.length > 1 ? "the first: " : ""}${reason}`;
  });
  const wide = points.filter(
    ({ result }) => method.options.method === "certified" && result?.converged === false,
  );
  if (wide.length === 0) return failures;
  return [...failures, `interval wider than the tolerance ${positionsText(wide)}: time limit`];
}

function positionsText(points: SweepPoint[]): string {
  if (points.length > MAX_LISTED) return `at ${points.length} positions`;
  return `at ${points.map(({ position }) => axisNumber(position)).join(", ")}`;
}
