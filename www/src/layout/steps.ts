// The three steps of the panel: their buttons scroll to them, and say in which one the panel is.
import { element } from "../common/elements.ts";

const panel = element("panel");
const nav = element("steps");

/** Where the eye is in the panel, as a part of its height. */
const READ = 0.3;
/** Milliseconds after a step was chosen in which scrolling is what that did. */
const CHOSEN = 300;

/** Connects the buttons of the steps. */
export function connectSteps(): void {
  const buttons = [...nav.querySelectorAll<HTMLButtonElement>("[data-step]")];
  const stepOf = ({ dataset }: HTMLButtonElement) => element(dataset.step ?? "");
  let chosen = 0;
  const show = (current: HTMLButtonElement | undefined) => {
    for (const button of buttons) {
      if (button === current) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
  };
  const mark = () => {
    // The last steps may be too short to reach the top: the one that was chosen is marked.
    if (performance.now() - chosen < CHOSEN) return;
    const { bottom } = nav.getBoundingClientRect();
    const line = bottom + READ * (panel.getBoundingClientRect().bottom - bottom);
    const reached = buttons.filter((button) => stepOf(button).getBoundingClientRect().top <= line);
    show(reached.at(-1) ?? buttons[0]);
  };
  for (const button of buttons) {
    button.addEventListener("click", () => {
      chosen = performance.now();
      stepOf(button).scrollIntoView({ block: "start" });
      show(button);
    });
  }
  panel.addEventListener("scroll", mark, { passive: true });
  mark();
}
