// The rows of the tree of parts and faces.

import { limitText, ownLimit, setOwnLimit } from "../results/ownLimits.ts";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";

/** What a row stands for, and what its controls do. */
export interface RowOptions {
  side: Side;
  /** As shown, and as controls are named by. */
  name: string;
  fullName: string;
  isChanged: boolean;
  /** Some faces are drawn and others not: neither. */
  shown: boolean | undefined;
  show: (shown: boolean) => void;
  only: () => void;
  look: () => void;
}

/** Returns the controls of a row, between which its own are put: a checkbox, a letter, a name, `only`. */
export function rowParts(options: RowOptions) {
  const { side, name, fullName, isChanged, shown } = options;
  const letter = document.createElement("b");
  letter.className = side;
  letter.textContent = side.toUpperCase();
  const look = button(name, options.look);
  look.className = "name";
  look.dataset.changed = `${isChanged}`;
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = shown === true;
  box.indeterminate = shown === undefined;
  box.setAttribute("aria-label", texts.faces.show(side.toUpperCase(), fullName));
  box.addEventListener("input", (event) => {
    event.stopPropagation();
    options.show(box.checked);
  });
  const alone = button(texts.faces.only, options.only);
  alone.setAttribute("aria-label", texts.faces.showOnly(side.toUpperCase(), fullName));
  return { box, letter, look, alone };
}

/** Returns what can be done with a row, shown where it is pointed at or has the focus. */
export function acts(...controls: HTMLElement[]): HTMLElement {
  const node = document.createElement("span");
  node.className = "acts";
  node.append(...controls);
  return node;
}

/** Returns the field of what is allowed of a face alone. */
export function limitInput(side: Side, face: number, name: string): HTMLInputElement {
  const input = document.createElement("input");
  input.type = "text";
  input.inputMode = "decimal";
  input.placeholder = "±";
  input.className = "own-limit";
  Object.assign(input.dataset, { side, face });
  input.value = ownText(side, face);
  input.setAttribute("aria-label", texts.faces.allowedDeviationOf(side.toUpperCase(), name));
  input.addEventListener("input", (event) => event.stopPropagation());
  input.addEventListener("change", () => {
    input.setAttribute("aria-invalid", `${!setOwnLimit(side, face, input.value)}`);
  });
  return input;
}

/** Shows the limits as they are after undoing, in the rows that there are. */
export function showLimits(list: HTMLElement): void {
  for (const input of list.querySelectorAll<HTMLInputElement>(".own-limit")) {
    input.value = ownText(input.dataset.side as Side, Number(input.dataset.face));
  }
}

function ownText(side: Side, face: number): string {
  const own = ownLimit(side, face);
  return own === undefined ? "" : limitText(own);
}

function button(text: string, pressed: () => void): HTMLButtonElement {
  const node = document.createElement("button");
  node.type = "button";
  node.textContent = text;
  node.addEventListener("click", pressed);
  return node;
}
