// Elements of drawings.

const SVG = "http://www.w3.org/2000/svg";

/** Returns an element of a drawing. */
export function draw(
  name: string,
  attributes: Readonly<Record<string, string | number>>,
  text = "",
): SVGElement {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, `${value}`);
  node.textContent = text;
  return node;
}
