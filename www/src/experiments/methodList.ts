// The list of methods: check boxes that are also the legend of the curves.
import { element } from "../common/elements.ts";
import { CERTIFIED, type Entry } from "./sweep/methods.ts";

const list = element("methods");

/** Fills the list. */
export function fill(entries: Entry[]): void {
  list.replaceChildren(...entries.map(row));
}

export function isChosen(method: string): boolean {
  return rowOf(method).querySelector("input")?.checked === true;
}

/** Returns the colour of a method in the current colour scheme. */
export function colorOf(method: string): string {
  return getComputedStyle(rowOf(method).querySelector("i") ?? list).color;
}

/** Shows notes on a method's results below its name. */
export function setNotes(method: string, notes: string[]): void {
  const lines = notes.map((note) => {
    const line = document.createElement("li");
    line.textContent = note;
    return line;
  });
  rowOf(method)
    .querySelector("ul")
    ?.replaceChildren(...lines);
}

function rowOf(method: string): Element {
  const found = list.querySelector(`[data-method="${method}"]`);
  if (found === null) throw new Error(`there is no method ${method}`);
  return found;
}

function row({ name, byDefault }: Entry): HTMLElement {
  const item = document.createElement("div");
  item.dataset.method = name;
  const label = document.createElement("label");
  const input = document.createElement("input");
  input.type = "checkbox";
  input.checked = byDefault;
  // Always computed, because the others are compared with it.
  input.disabled = name === CERTIFIED;
  label.append(input, document.createElement("i"), name);
  item.append(label, document.createElement("ul"));
  return item;
}
