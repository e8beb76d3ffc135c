// Light or dark, as the system is unless the user wants one of both.
import { element } from "../common/elements.ts";
import { keep, kept } from "../state/workplace.ts";

const choice = element("theme", HTMLSelectElement);

/** Connects the choice, which is kept in this browser. */
export function connectTheme(): void {
  const wanted = kept("theme");
  if (wanted === "light" || wanted === "dark") choice.value = wanted;
  choice.addEventListener("input", () => {
    keep("theme", choice.value);
    show();
  });
  show();
}

function show(): void {
  document.documentElement.dataset.theme = choice.value;
}
