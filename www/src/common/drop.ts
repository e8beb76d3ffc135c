// Drag and drop of model files. The left half of the view and A's row of the
// panel take model A, the right half and B's row take model B; two files
// dropped together become A and B, and more are left out.
import { SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { element } from "./elements.ts";

/** Where files were dropped: on a model's place, or with `undefined` where either may be meant. */
export type DropPlace = Side | undefined;

/** The models that files are for: two are A and B, and one is that of the place. */
export function sidesOf(
  [first, second]: readonly File[],
  place: DropPlace,
): Sides<File> | undefined {
  if (first === undefined) return undefined;
  if (second !== undefined) return { a: first, b: second };
  return place && { [place]: first };
}

/** Calls back with files that are dropped, and where; `zone` takes them for either model. */
export function onFilesDropped(
  callback: (files: readonly File[], place: DropPlace) => void,
  zone?: HTMLElement,
): void {
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
    const files = Array.from(event.dataTransfer.files);
    const side = sideAt(event);
    const isZone = event.target instanceof Node && zone?.contains(event.target);
    if (files.length > 1 || side !== undefined || isZone) callback(files, side);
  });
}
