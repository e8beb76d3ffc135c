// The button that fits A to B, and what it found.
import { element } from "../common/elements.ts";
import { distanceText } from "../common/text/numbers.ts";
import type { FitReply } from "../worker/protocol.ts";

const START = "Best fit";
const STOP = "Stop fitting";

const button = element("best-fit", HTMLButtonElement);
const text = element("fit-text");

const POOR_TEXT =
  ". A poor fit: the parts differ much, or A has to be turned by hand near to where it belongs.";

let running = false;
/** Whether the fit lays A on B by what was picked alone. */
let isByHand = false;

/** Calls back when the user starts or stops a fit. */
export function onFit(start: () => void, stop: () => void): void {
  button.addEventListener("click", () => {
    if (running) stop();
    else start();
  });
}

/** Says that a fit was started; by hand, A is laid on B and not fitted. */
export function showFitting(byHand: boolean): void {
  isByHand = byHand;
  setRunning(true);
  text.textContent = "fitting…";
}

/** Shows the state of a fit; lengths are shown with the digits that the diagonal gives sense. */
export function showFit(reply: FitReply, diagonal: number): void {
  const length = (value: number) => `≈ ${distanceText(value, diagonal)}`;
  switch (reply.state) {
    case "working":
      text.textContent =
        reply.step > 0
          ? `step ${reply.step}: RMS ${length(reply.rms)}`
          : `searching poses: ${Math.round(100 * reply.fraction)} %`;
      return;
    case "done": {
      const { rms, rmsBefore, steps, converged, ambiguous } = reply.fit;
      const end = converged ? "" : ", not converged";
      const poor = converged || isByHand ? "" : POOR_TEXT;
      const how = isByHand ? "laid on by hand" : `${steps} steps${end}`;
      const others = ambiguous.length > 0 ? `; ${ambiguous.length} other poses fit as well` : "";
      text.textContent = `RMS ${length(rmsBefore)} before, ${length(rms)} now (${how})${others}${poor}`;
      text.dataset.poor = `${poor !== ""}`;
      break;
    }
    default:
      text.textContent = reply.state;
  }
  setRunning(false);
}

/** Forgets a fit, because A was moved or the models were replaced. */
export function clearFit(): void {
  text.textContent = "";
  setRunning(false);
}

/** Whether a fit is in progress. */
export const isFitting = (): boolean => running;

function setRunning(now: boolean): void {
  running = now;
  button.textContent = now ? STOP : START;
}
