// The read-out: distance, interval, details; or what went wrong. What tests
// and other programs may read is in the section's data attributes.
import type { DistanceResult } from "nurbs-hausdorff";
import { element } from "./elements.ts";
import { estimatesOf, type Fact, factsOf } from "./facts.ts";
import { distanceText, intervalText, rough } from "./numbers.ts";

const SO_FAR = "certain so far";
/** Both directions are computed in turn, each with an interval of its own. */
const ONE_DIRECTION = "one direction so far";

const section = element("result");
const distance = element("distance");
const interval = element("interval");
const width = element("width");
const progress = element("progress", HTMLProgressElement);
const error = element("error");
const facts = element("facts");
const estimates = element("estimates");
const statistics = element("statistics");

/** A measurement was asked for, of the same models. */
export function showPending(): void {
  section.dataset.state = "working";
  progress.value = 0;
}

/** Work has come this far, with the interval so far if the method has one. */
export function showWorking(
  fraction: number,
  now: [number, number] | undefined,
  diagonal: number,
  symmetric: boolean,
): void {
  section.dataset.state = "working";
  progress.value = fraction;
  if (now === undefined) return;
  showInterval(now[0], now[1], diagonal, symmetric ? ONE_DIRECTION : SO_FAR);
}

/** `last`: whether no newer measurement is on its way. */
export function showResult(result: DistanceResult, last: boolean): void {
  distance.textContent = distanceText(result.computed, result.diagonal);
  showInterval(result.lower, result.upper, result.diagonal, meaning(result, last));
  show(facts, factsOf(result));
  showEstimates(estimatesOf(result));
  const { a, b } = result.witness;
  Object.assign(section.dataset, {
    method: result.method,
    computed: result.computed,
    lower: result.lower,
    upper: result.upper,
    converged: result.converged,
    a: a.point.join(" "),
    b: b.point.join(" "),
    state: last ? "done" : "live",
  });
}

/** There is no result: it was cancelled, it failed, or the models are new. */
export function showNone(state: "cancelled" | "failed" | "working"): void {
  distance.textContent = "–";
  interval.textContent = state === "working" ? "computing" : state;
  width.textContent = "";
  facts.replaceChildren();
  showEstimates([]);
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

function showInterval(lower: number, upper: number, diagonal: number, how: string): void {
  interval.textContent = intervalText(lower, upper, diagonal);
  width.textContent = `${how} · width ${rough(upper - lower)}`;
}

/** What is known of the interval: that it contains the distance, whatever the method. */
function meaning({ method, converged }: DistanceResult, last: boolean): string {
  if (method !== "certified" || converged) return "certain to contain it";
  return last ? "certain, wider than asked" : SO_FAR;
}

function showEstimates(all: Fact[]): void {
  estimates.hidden = all.length === 0;
  show(statistics, all);
}

function show(list: HTMLElement, all: Fact[]): void {
  list.replaceChildren(
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
