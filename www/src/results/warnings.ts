// Warnings about what this machine cannot do. Each shows one line that unfolds
// to the reason; it goes when it no longer applies.

import { element } from "../common/elements.ts";
import { engineText } from "../common/engineText.ts";
import { texts } from "../texts/index.ts";
import type { EngineState } from "../worker/protocol.ts";

const TITLES = {
  webgl: texts.results.noWebGLTheModelsCannot,
  context: texts.results.theViewStandsStillThe,
  result: texts.results.theGPUCouldNotBe,
};
type Kind = keyof typeof TITLES;

const banner = element("banner");
const list = element("warnings");
/** The reasons of the warnings that apply now. */
const reasons = new Map<Kind, string>();
/** The reasons that the user has read and dismissed. */
const dismissed = new Map<Kind, string>();

element("dismiss").addEventListener("click", () => {
  for (const [kind, reason] of reasons) dismissed.set(kind, reason);
  draw();
});

/** Shows the backend, and why it is not a GPU: that costs time and is nothing to warn of. */
export function showEngine(engine: EngineState): void {
  const { notice } = engine;
  element("engine").textContent =
    notice === null ? engineText(engine) : `${engineText(engine)}: ${notice}`;
}

/** Shows why the GPU was not used for a distance; that there is no GPU is the engine's warning. */
export function showResultNotice(notice: string | undefined, engine: EngineState): void {
  set("result", notice === undefined || notice === engine.notice ? null : notice);
}

/** Shows why the models cannot be drawn. */
export function showNoWebGl(reason: string): void {
  set("webgl", reason);
}

/** Shows that the view cannot be drawn for a while, or that it can again. */
export function showContext(isThere: boolean): void {
  const reason = texts.results.numbersAndVerdictAreRight;
  set("context", isThere ? null : reason);
}

function set(kind: Kind, reason: string | null): void {
  if ((reasons.get(kind) ?? null) === reason) return;
  if (reason === null) reasons.delete(kind);
  else reasons.set(kind, reason);
  draw();
}

function draw(): void {
  const visible = [...reasons].filter(([kind, reason]) => dismissed.get(kind) !== reason);
  list.replaceChildren(...visible.map(([kind, reason]) => line(TITLES[kind], reason)));
  banner.hidden = visible.length === 0;
}

function line(title: string, reason: string): HTMLElement {
  const details = document.createElement("details");
  const summary = document.createElement("summary");
  summary.textContent = title;
  details.append(summary, reason);
  return details;
}
