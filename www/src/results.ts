// The read-out: distance, interval, details; or what went wrong. What tests
// and other programs may read is in the section's data attributes.
import type { DistanceResult } from "nurbs-hausdorff";
import { element } from "./elements.ts";
import { type Fact, factsOf } from "./facts.ts";
import { distanceText, intervalText, rough } from "./numbers.ts";

const section = element("result");
const distance = element("distance");
const interval = element("interval");
const width = element("width");
const progress = element("progress", HTMLProgressElement);
const error = element("error");
const facts = element("facts");

/** Work has come this far, with the interval so far if the method has one. */
export function showWorking(fraction: number, now: [number, number] | undefined): void {
  section.dataset.state = "working";
  progress.value = fraction;
  if (now !== undefined) showInterval(now[0], now[1], "so far");
}

/** `last`: whether no newer measurement is on its way. */
export function showResult(result: DistanceResult, last: boolean): void {
  distance.textContent = distanceText(result.computed, result.diagonal);
  showInterval(result.lower, result.upper, result.converged ? "certain" : "certain, not converged");
  showFacts(factsOf(result));
  const { a, b } = result.witness;
  Object.assign(section.dataset, {
    method: result.method,
    computed: result.computed,
    lower: result.lower,
    upper: result.upper,
    converged: result.converged,
    a: a.point.join(" "),
    b: b.point.join(" "),
    state: last ? "done" : "working",
  });
}

/** There is no result, as it was cancelled or failed. */
export function showNone(state: "cancelled" | "failed"): void {
  distance.textContent = "–";
  interval.textContent = state;
  width.textContent = "";
  facts.replaceChildren();
  for (const name of ["method", "computed", "lower", "upper", "converged", "a", "b"]) {
    delete section.dataset[name];
  }
  section.dataset.state = state;
}

export function showError(code: string, message: string): void {
  error.hidden = false;
  error.dataset.code = code;
  error.textContent = `${code}: ${message}`;
}

export function hideError(): void {
  error.hidden = true;
  delete error.dataset.code;
}

function showInterval(lower: number, upper: number, how: string): void {
  interval.textContent = intervalText(lower, upper);
  width.textContent = `width ${rough(upper - lower)}, ${how}`;
}

function showFacts(all: Fact[]): void {
  facts.replaceChildren(
    ...all.flatMap(([term, text]) => [definition("dt", term), definition("dd", text)]),
  );
}

/** With what follows `_` up to the comma below the line. */
function definition(name: "dt" | "dd", text: string): HTMLElement {
  const node = document.createElement(name);
  const [before = "", below, after = ""] = text.split(/_(\w+)/);
  node.append(before);
  if (below !== undefined) {
    const sub = document.createElement("sub");
    sub.textContent = below;
    node.append(sub, after);
  }
  return node;
}
