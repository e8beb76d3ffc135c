// Typed look-up of the page's elements.

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
