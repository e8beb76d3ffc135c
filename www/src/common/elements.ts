// The page's elements: typed look-up, and what lists are made of.

import { texts } from "../texts/index.ts";
/**
 * Returns the element with this identifier.
 *
 * @throws {Error} if the page has no such element of this type.
 */
export function element(id: string): HTMLElement;
export function element<T extends Element>(id: string, type: new () => T): T;
export function element(id: string, type: new () => Element = HTMLElement): Element {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`the page has no ${type.name} ${id}`);
  return found;
}

/** Returns a `span` of a class with a text. */
export function span(name: string, text: string): HTMLElement {
  const node = document.createElement("span");
  node.className = name;
  node.textContent = text;
  return node;
}

/** Returns an element with texts or other elements in it; attributes are given by name. */
export function make(
  name: string,
  content: readonly (string | Node)[] | string = [],
  attributes: Readonly<Record<string, string>> = {},
): HTMLElement {
  const node = document.createElement(name);
  node.append(...(typeof content === "string" ? [content] : content));
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return node;
}

/** Fills a list with rows of the first entries, and says how many more there are than `most`. */
export function fillList<Entry>(
  list: HTMLElement,
  entries: readonly Entry[],
  most: number,
  row: (entry: Entry) => HTMLElement,
): void {
  list.replaceChildren(...entries.slice(0, most).map(row));
  if (entries.length <= most) return;
  const more = document.createElement("li");
  more.className = "note";
  more.textContent = texts.common.andMore(entries.length - most);
  list.append(more);
}
