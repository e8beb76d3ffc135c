// Elements of the report, which is a document of its own.

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

/** Returns a table with a head; numbers stand to the right. */
export function table(head: readonly string[], rows: readonly (readonly string[])[]): HTMLElement {
  const cells = (name: string, texts: readonly string[]) =>
    make(
      "tr",
      texts.map((text, column) => make(name, text, column > 0 ? { class: "number" } : {})),
    );
  return make("table", [
    make("thead", [cells("th", head)]),
    make(
      "tbody",
      rows.map((row) => cells("td", row)),
    ),
  ]);
}

/** Returns terms with their texts; those without a text are left out. */
export function terms(all: readonly (readonly [term: string, text: string])[]): HTMLElement {
  return make(
    "dl",
    all.flatMap(([term, text]) => (text === "" ? [] : [make("dt", term), make("dd", text)])),
  );
}

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
