// The three steps of the panel: their buttons scroll to them, and say in which one the panel is.
import { element } from "../common/elements.ts";

const panel = element("panel");
const nav = element("steps");

/** Connects the buttons of the steps. */
export function connectSteps(): void {
  const buttons = [...nav.querySelectorAll<HTMLButtonElement>("[data-step]")];
  const stepOf = ({ dataset }: HTMLButtonElement) => element(dataset.step ?? "");
  const mark = () => {
    const line = nav.getBoundingClientRect().bottom + 1;
    const isAtEnd = panel.scrollTop + panel.clientHeight >= panel.scrollHeight - 1;
    const reached = buttons.filter((button) => stepOf(button).getBoundingClientRect().top <= line);
    const isScrolled = panel.scrollTop > 0;
    const current = isAtEnd && isScrolled ? buttons.at(-1) : (reached.at(-1) ?? buttons[0]);
    for (const button of buttons) {
      if (button === current) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
  };
  for (const button of buttons) {
    button.addEventListener("click", () => stepOf(button).scrollIntoView({ block: "start" }));
  }
  panel.addEventListener("scroll", mark, { passive: true });
  mark();
}
