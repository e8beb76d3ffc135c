// The read-out: distance, interval, bounds, time; or what went wrong.
import type { DistanceResult } from "nurbs-hausdorff";
import { element } from "./elements.ts";
import { distanceText, milliseconds, precise, rough } from "./numbers.ts";

const section = element("result");
const distance = element("distance");
const interval = element("interval");
const work = element("work");
const progress = element("progress", HTMLProgressElement);
const error = element("error");
const facts = element("facts");

export function showWorking(fraction: number, now: [number, number] | undefined): void {
  section.dataset.state = "working";
  work.hidden = false;
  progress.value = fraction;
  if (now !== undefined) interval.textContent = intervalText(now[0], now[1]);
}

export function showError(code: string, message: string): void {
  section.dataset.state = "failed";
  work.hidden = true;
  error.hidden = false;
  error.dataset.code = code;
  error.textContent = `${code}: ${message}`;
}

export function hideError(): void {
  error.hidden = true;
  delete error.dataset.code;
}

export function showCancelled(): void {
  section.dataset.state = "cancelled";
  work.hidden = true;
  interval.textContent = "cancelled";
}

export function showResult(result: DistanceResult): void {
  work.hidden = true;
  distance.textContent = distanceText(result.computed, result.diagonal);
  interval.textContent = intervalText(result.lower, result.upper);
  facts.replaceChildren(
    ...factsOf(result).flatMap(([term, text]) => [node("dt", term), node("dd", text)]),
  );
  const { a, b } = result.witness;
  Object.assign(section.dataset, {
    method: result.method,
    computed: result.computed,
    lower: result.lower,
    upper: result.upper,
    converged: result.converged,
    a: a.point.join(" "),
    b: b.point.join(" "),
    state: "done",
  });
}

function intervalText(lower: number, upper: number): string {
  return `certainly in [${precise(lower)}, ${precise(upper)}], width ${rough(upper - lower)}`;
}

function factsOf(result: DistanceResult): [term: string, text: string][] {
  const { seconds, patches, statistics } = result;
  const facts: [string, string][] = [
    ["time", `${milliseconds(seconds.solve)} on the ${result.backend.toUpperCase()}`],
    ["preparation", milliseconds(seconds.prepare + seconds.compile)],
  ];
  if (result.method === "certified") {
    facts.push(["cells", `${result.cells.toLocaleString("en")} in ${result.levels} levels`]);
    if (!result.converged) facts.push(["ended by", result.stop]);
  } else if (result.method === "hierarchy") {
    const pairs = Math.max(...result.hierarchy.pairs);
    facts.push(["pairs of boxes, at most", pairs.toLocaleString("en")]);
  } else {
    const { bounds, samples, statuses } = result;
    facts.push(
      ["K_A, published", bounds.k_a.toPrecision(5)],
      ["K_A, rigorous", bounds.k_a_rigorous.toPrecision(5)],
      ["K_B, observed", bounds.k_b === null ? "none" : bounds.k_b.toPrecision(3)],
      ["samples", samples.toLocaleString("en")],
      ["at iteration limit", statuses.iteration_limit.toLocaleString("en")],
    );
  }
  facts.push(["patches", `${patches.a.toLocaleString("en")} · ${patches.b.toLocaleString("en")}`]);
  if (statistics !== undefined) {
    const estimate = (value: number) => `≈ ${distanceText(value, result.diagonal)}`;
    facts.push(
      ["mean", estimate(statistics.mean)],
      ["rms", estimate(statistics.rms)],
      ["95 % of the area", estimate(statistics.percentile_95)],
    );
  }
  return facts;
}

function node(name: "dt" | "dd", text: string): HTMLElement {
  const node = document.createElement(name);
  node.textContent = text;
  return node;
}
