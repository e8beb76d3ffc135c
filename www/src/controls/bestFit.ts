// The button that fits A to B, and what it found.

import { element } from "../common/elements.ts";
import { distanceText } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import type { FitReply } from "../worker/protocol.ts";

const START = texts.files.bestFit;
const STOP = texts.files.stopFitting;

const button = element("best-fit", HTMLButtonElement);
const text = element("fit-text");

const POOR_TEXT = texts.files.poorFit;

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
  text.textContent = texts.files.fitting;
}

/** Shows the state of a fit; lengths are shown with the digits that the diagonal gives sense. */
export function showFit(reply: FitReply, diagonal: number): void {
  const length = (value: number) => `≈ ${distanceText(value, diagonal)}`;
  switch (reply.state) {
    case "working":
      text.textContent =
        reply.step > 0
          ? texts.files.stepRMS(reply.step, length(reply.rms))
          : texts.files.searchingPoses(Math.round(100 * reply.fraction));
      return;
    case "done": {
      const { rms, rmsBefore, steps, converged, ambiguous, counted, samples, taken } = reply.fit;
      const end = converged ? "" : texts.files.notConverged;
      const poor = converged || isByHand ? "" : POOR_TEXT;
      const how = isByHand ? texts.files.laidOnByHand : texts.files.steps(steps, end);
      const without = (taken ?? []).flatMap((count, datum) => (count === 0 ? [datum + 1] : []));
      const idle = without.length > 0 ? texts.files.datumsTookNothing(without.join(", ")) : "";
      const of = counted < samples ? texts.files.countedOf(counted, samples) : "";
      const others = ambiguous.length > 0 ? texts.files.otherPoses(ambiguous.length) : "";
      text.textContent = texts.files.rmsBeforeNow(
        length(rmsBefore),
        length(rms),
        how,
        of + idle + others,
        poor,
      );
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
