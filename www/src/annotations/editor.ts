// The field in which the text of an annotation is written.

import { make } from "../common/elements.ts";
import { texts } from "../texts/index.ts";
import { MAX_TEXT } from "./annotations.ts";

export interface EditorListener {
  save: (text: string) => void;
  cancel: () => void;
  /** Removes the annotation, if there is one. */
  remove: (() => void) | undefined;
}

/** Returns the field: Enter keeps the text, Shift and Enter begin a line, Escape leaves it as it was. */
export function editor(text: string, { save, cancel, remove }: EditorListener): HTMLElement {
  const area = document.createElement("textarea");
  Object.assign(area, { value: text, maxLength: MAX_TEXT, rows: 3 });
  area.placeholder = texts.places.whatIsToBeSaid;
  area.setAttribute("aria-label", texts.places.textOfTheAnnotation);
  const keep = button(texts.places.save, () => save(area.value));
  const others =
    remove === undefined
      ? [button(texts.places.cancel, cancel)]
      : [button(texts.places.delete, remove)];
  const field = make("div", [area, make("div", [keep, ...others], { class: "buttons" })], {
    class: "annotation editor",
  });
  field.addEventListener("keydown", (event) => {
    const { key, shiftKey } = event;
    if (key !== "Escape" && (key !== "Enter" || shiftKey || event.target !== area)) return;
    event.preventDefault();
    event.stopPropagation();
    if (key === "Enter") save(area.value);
    else cancel();
  });
  return field;
}

function button(text: string, click: () => void): HTMLElement {
  const node = make("button", text, { type: "button" });
  node.addEventListener("click", click);
  return node;
}
