// Elements of the report, which is a document of its own.
import { make } from "../../common/elements.ts";

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
