// Notes on a curve that the plots do not show.

import { axisNumber } from "../common/plots/axisNumber.ts";
import { texts } from "../texts/index.ts";
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
    if (code === "left-out") return texts.experiments.leftOut(reason);
    return `${code} ${positionsText(failed)}; ${failed.length > 1 ? texts.experiments.theFirst : ""}${reason}`;
  });
  const wide = points.filter(
    ({ result }) => method.options.method === "certified" && result?.converged === false,
  );
  if (wide.length === 0) return failures;
  return [...failures, texts.experiments.intervalWiderThanTheTolerance(positionsText(wide))];
}

function positionsText(points: SweepPoint[]): string {
  if (points.length > MAX_LISTED) return texts.experiments.atPositions(points.length);
  return texts.experiments.atThese(points.map(({ position }) => axisNumber(position)).join(", "));
}
