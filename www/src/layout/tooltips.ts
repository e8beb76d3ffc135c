// What a tool does, and its key, below it while it is pointed at. Names for readers of the screen
// are the tools' own.
import { element } from "../common/elements.ts";

/** Milliseconds for which a tool is pointed at before. */
const PAUSE = 350;
/** Pixels from a tool to what is said of it, and from the window's edges. */
const GAP = 6;

const tip = element("tip");

/** Connects all tools that have something to say. */
export function connectTooltips(): void {
  let timer = 0;
  let last = "";
  const placeOf = ({ clientX, clientY }: MouseEvent) => `${clientX} ${clientY}`;
  window.addEventListener("pointermove", (event) => {
    last = placeOf(event);
  });
  const hide = () => {
    clearTimeout(timer);
    tip.hidden = true;
  };
  for (const tool of document.querySelectorAll<HTMLElement>("[data-tip]")) {
    tool.addEventListener("pointerenter", (event) => {
      // A finger hides what it points at; a tool that comes below a pointer at rest is not asked for.
      if (event.pointerType !== "mouse" || placeOf(event) === last) return;
      clearTimeout(timer);
      timer = window.setTimeout(() => show(tool), PAUSE);
    });
    for (const end of ["pointerleave", "pointerdown", "click"]) tool.addEventListener(end, hide);
  }
  window.addEventListener("keydown", hide);
}

function show(tool: HTMLElement): void {
  const control = tool.querySelector<HTMLElement>("[data-key]") ?? tool;
  const { key, shownKey = key } = control.dataset;
  tip.replaceChildren(tool.dataset.tip ?? "");
  if (shownKey !== undefined) {
    const node = document.createElement("kbd");
    node.textContent = shownKey.replace(/^[a-z]$/, (letter) => letter.toUpperCase());
    tip.append(node);
  }
  tip.hidden = false;
  const { left, bottom, width } = tool.getBoundingClientRect();
  const middle = left + width / 2 - tip.offsetWidth / 2;
  tip.style.left = `${Math.max(GAP, Math.min(innerWidth - tip.offsetWidth - GAP, middle))}px`;
  tip.style.top = `${bottom + GAP}px`;
}
