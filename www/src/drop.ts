// Files dropped on the page: on the view's left half A, on its right half B,
// or on a model's row of the panel; two files are both.
import { element } from "./elements.ts";
import { SIDES, type Side, type Sides } from "./protocol.ts";

export function onDrop(callback: (files: Sides<File>) => void): void {
  const stage = element("stage");
  const overlay = element("drop");
  const rows: Record<Side, HTMLElement> = { a: element("model-a"), b: element("model-b") };

  const sideAt = (event: DragEvent): Side | undefined => {
    const target = event.target instanceof Node ? event.target : null;
    const row = SIDES.find((side) => rows[side].contains(target));
    if (row !== undefined || !stage.contains(target)) return row;
    const { left, width } = stage.getBoundingClientRect();
    return event.clientX < left + width / 2 ? "a" : "b";
  };

  // Everywhere, or else the browser leaves the page for the file.
  window.addEventListener("dragover", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    overlay.hidden = false;
    overlay.dataset.side = sideAt(event) ?? "";
  });
  window.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) overlay.hidden = true;
  });
  window.addEventListener("drop", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    overlay.hidden = true;
    const [first, second] = Array.from(event.dataTransfer.files);
    if (first === undefined) return;
    const side = sideAt(event);
    if (second !== undefined) callback({ a: first, b: second });
    else if (side !== undefined) callback({ [side]: first });
  });
}
