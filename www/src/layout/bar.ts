// The bar's tools that lead elsewhere: to a part of the panel, which is unfolded and shown, or to
// the list of parts.
import { element } from "../common/elements.ts";

/** Where the list of parts has room beside the view, as the style sheet has it; else it lies over the view. */
const roomForSide = matchMedia("(min-width: 1101px)");

const sideToggle = element("side-toggle", HTMLButtonElement);

/** Shows a part of the panel, unfolded, and gives a control of it the focus. */
export function reveal(id: string, control?: string): void {
  const part = element(id);
  for (let at: Element | null = part; at !== null; at = at.parentElement) {
    if (at instanceof HTMLDetailsElement) at.open = true;
  }
  // A sheet that is folded shows its head only.
  if (element("sheet").offsetParent !== null && !element("panel").classList.contains("open")) {
    element("sheet").click();
  }
  part.scrollIntoView({ block: "start" });
  if (control !== undefined) element(control).focus({ preventScroll: true });
}

/** Connects the tools that lead to parts of the panel. */
export function connectBar(): void {
  element("to-clearance").addEventListener("click", () => {
    reveal("clearance-details", "clearance-start");
  });
  element("to-colours").addEventListener("click", () => reveal("map-controls", "scale-map"));
  element("legend-controls").addEventListener("click", () => reveal("map-controls", "scale-map"));
  element("to-best-fit").addEventListener("click", () => {
    reveal("alignment");
    element("best-fit").click();
  });
  element("to-picture").addEventListener("click", () => element("export-png").click());
  sideToggle.addEventListener("click", () => showSide(!isSideShown()));
  roomForSide.addEventListener("change", ({ matches }) => showSide(matches));
  showSide(roomForSide.matches);
}

const isSideShown = (): boolean => document.body.dataset.side === "open";

function showSide(shown: boolean): void {
  document.body.dataset.side = shown ? "open" : "closed";
  sideToggle.setAttribute("aria-expanded", `${shown}`);
}
