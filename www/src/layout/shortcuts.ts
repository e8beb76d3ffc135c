// The keys of tools, as the page's markup states them beside each tool, and the list of all keys.

import { element } from "../common/elements.ts";
import { texts } from "../texts/index.ts";

type Tool = HTMLButtonElement | HTMLInputElement | HTMLSelectElement;

/** Keys that are no tool's. */
const OTHERS: readonly (readonly [keys: string, what: string])[] = [
  [texts.common.esc, texts.common.showWhatWasSeenBefore],
  [texts.common.enter, texts.common.pinAPointInThe],
  ["← ↑ → ↓", texts.common.turnTheView],
  [texts.common.doubleClick, texts.common.showBothModels],
];

const dialog = element("shortcuts", HTMLDialogElement);

const tools = (): Tool[] => [...document.querySelectorAll<Tool>("[data-key]")];

/** Connects the keys, and the list of them. */
export function connectShortcuts(): void {
  for (const tool of tools()) {
    const { key = "" } = tool.dataset;
    tool.setAttribute("aria-keyshortcuts", key);
  }
  window.addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, altKey, target, defaultPrevented } = event;
    if (ctrlKey || metaKey || altKey || defaultPrevented || dialog.open || isTyped(target)) return;
    // The places have their key themselves.
    const tool = tools().find(({ dataset }) => dataset.key === key.toLowerCase());
    if (tool === undefined || tool.disabled || tool.offsetParent === null) return;
    event.preventDefault();
    use(tool);
  });
  element("help").addEventListener("click", () => {
    fill();
    dialog.showModal();
  });
}

/** What a click on a tool does; the list of one that has choices is opened. */
function use(tool: Tool): void {
  if (!(tool instanceof HTMLSelectElement)) {
    tool.click();
    return;
  }
  tool.focus();
  try {
    tool.showPicker();
  } catch {
    // A browser that does not open lists by itself: the focus is there.
  }
}

/** Whether keys are what is written, or chosen from a list. */
const isTyped = (target: EventTarget | null): boolean =>
  target instanceof HTMLSelectElement ||
  target instanceof HTMLTextAreaElement ||
  (target instanceof HTMLInputElement && !["checkbox", "range"].includes(target.type));

function fill(): void {
  const own = [...document.querySelectorAll<HTMLElement>("[data-key], [data-shown-key]")].map(
    (tool) =>
      [
        (tool.dataset.shownKey ?? tool.dataset.key ?? "").replace(/^[a-z]$/, (key) =>
          key.toUpperCase(),
        ),
        tool.ariaLabel ?? tool.textContent?.trim() ?? "",
      ] as const,
  );
  const rows = [...own, ...OTHERS].flatMap(([keys, what]) => {
    const [term, text] = [document.createElement("dt"), document.createElement("dd")];
    const key = document.createElement("kbd");
    term.textContent = what;
    key.textContent = keys;
    text.append(key);
    return [term, text];
  });
  element("shortcut-list").replaceChildren(...rows);
}
