// Drag and drop of model files. The left half of the view and A's row of the
// panel take model A, the right half and B's row take model B; two files
// dropped together become A and B.
import { SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { element } from "./elements.ts";

/** Calls back with files that are dropped; `zone` takes them for either model, one after the other. */
export function onFilesDropped(callback: (files: Sides<File>) => void, zone?: HTMLElement): void {
  const stage = element("stage");
  const overlay = element("drop");
  const rows: Record<Side, HTMLElement> = { a: element("model-a"), b: element("model-b") };

  let nextSide: Side = "a";
  const sideAt = (event: DragEvent): Side | undefined => {
    const target = event.target instanceof Node ? event.target : null;
    const row = SIDES.find((side) => rows[side].contains(target));
    if (zone?.contains(target)) return nextSide;
    if (row !== undefined || !stage.contains(target)) return row;
    const { left, width } = stage.getBoundingClientRect();
    return event.clientX < left + width / 2 ? "a" : "b";
  };

  // On the whole window: a browser opens a file whose drop nobody handles.
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
    else if (side !== undefined) {
      callback({ [side]: first });
      nextSide = side === "a" ? "b" : "a";
    }
  });
}
