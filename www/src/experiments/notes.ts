// What a reader must know of a curve, and does not see.
import { axisNumber } from "./axis-number.ts";
import type { Curve, Outcome } from "./outcome.ts";

/** Positions that are named one by one, at most. */
const FEW = 3;

/** Failures by their code, what was left out with the reason, and intervals wider than asked. */
export function notesOf({ method, outcomes }: Curve): string[] {
  const byCode = new Map<string, Outcome[]>();
  for (const outcome of outcomes) {
    const { failure } = outcome;
    if (failure === undefined) continue;
    byCode.set(failure.code, [...(byCode.get(failure.code) ?? []), outcome]);
  }
  const failures = [...byCode].map(([code, failed]) => {
    const why = failed[0]?.failure?.message ?? "";
    if (code === "left-out") return `left out: ${why}`;
    return `${code} ${places(failed)}; ${failed.length > 1 ? "first" : "there"}: ${why}`;
  });
  const loose = outcomes.filter(
    ({ result }) => method.options.method === "certified" && result?.converged === false,
  );
  if (loose.length === 0) return failures;
  return [...failures, `interval wider than asked ${places(loose)}: out of time`];
}

function places(outcomes: Outcome[]): string {
  if (outcomes.length > FEW) return `at ${outcomes.length} positions`;
  return `at ${outcomes.map(({ position }) => axisNumber(position)).join(", ")}`;
}
