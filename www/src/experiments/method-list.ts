// The methods as check boxes, which are the key to the curves as well.
import { element } from "../elements.ts";
import { CERTIFIED, type Entry } from "./methods.ts";

const list = element("methods");

/** Fills the list. */
export function offer(entries: Entry[]): void {
  list.replaceChildren(...entries.map(row));
}

export function isChosen(method: string): boolean {
  return rowOf(method).querySelector("input")?.checked === true;
}

/** The colour that a method has in the list, as it is in the scheme of the moment. */
export function colorOf(method: string): string {
  return getComputedStyle(rowOf(method).querySelector("i") ?? list).color;
}

/** Says what came of a method, below its name. */
export function tell(method: string, notes: string[]): void {
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

function row({ name, usual }: Entry): HTMLElement {
  const item = document.createElement("div");
  item.dataset.method = name;
  const label = document.createElement("label");
  const input = document.createElement("input");
  input.type = "checkbox";
  input.checked = usual;
  // The others are compared with it.
  input.disabled = name === CERTIFIED;
  label.append(input, document.createElement("i"), name);
  item.append(label, document.createElement("ul"));
  return item;
}
