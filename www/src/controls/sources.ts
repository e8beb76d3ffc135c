// Selection of the models: the lists of pairs and shapes, and files.
import type { ShapeInfo } from "nurbs-hausdorff";
import { onFilesDropped } from "../common/drop.ts";
import { element } from "../common/elements.ts";
import { ACCEPT } from "../files/formats.ts";
import { allowed, setAllowed } from "../results/verdict.ts";
import {
  type DisplayModel,
  type Placement,
  SIDES,
  type Side,
  type Sides,
  type Source,
} from "../worker/protocol.ts";
import { IN_PLACE, presets } from "./presets.ts";

/** The value of the list entry that stands for models outside the list, such as files. */
const OTHER = "";

const pair = element("preset", HTMLSelectElement);
const lists: Record<Side, HTMLSelectElement> = {
  a: element("shape-a", HTMLSelectElement),
  b: element("shape-b", HTMLSelectElement),
};

/** The shapes shown. */
const shown: Sides<string> = {};
let open: (sources: Sides<Source>, placement: Placement) => void = () => {};
/** The allowed deviation that an example began with, until the user changes it. */
let proposed: number | undefined;
/** What the models that are being opened propose: a file that cannot be read leaves what is allowed. */
let awaited: { limit?: number | undefined } | undefined;

/** Allows what an example states; models of the user are not judged by an example's. */
function propose(limit: number | undefined): void {
  if (proposed === undefined && limit === undefined) return;
  const isProposed = allowed()?.above === proposed;
  if (limit !== undefined || isProposed) setAllowed(limit);
  proposed = limit;
}

/** Calls back with the models that the user selects. Only presets move A; other models keep their positions. */
export function onSource(listener: (sources: Sides<Source>, placement: Placement) => void): void {
  const callback = (sources: Sides<Source>, placement: Placement, limit?: number) => {
    awaited = { limit };
    listener(sources, placement);
  };
  open = listener;
  pair.append(
    ...presets.map(({ title }, index) => new Option(title, `${index}`)),
    otherOption("own pair"),
  );
  pair.addEventListener("change", () => {
    const preset = presets[Number(pair.value)];
    if (preset === undefined) return;
    callback({ a: { shape: preset.a }, b: { shape: preset.b } }, preset.placement, preset.allowed);
  });
  for (const side of SIDES) {
    lists[side].addEventListener("change", () => {
      callback({ [side]: { shape: lists[side].value } }, IN_PLACE);
    });
    const input = element(`file-${side}`, HTMLInputElement);
    input.accept = ACCEPT;
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) callback({ [side]: { file } }, IN_PLACE);
      // Otherwise choosing the same file again, after an edit, raises no event.
      input.value = "";
    });
  }
  const openFiles = (files: Sides<File>) => callback(sourcesOf(files), IN_PLACE);
  onFilesDropped(openFiles, element("dropzone"));
  const both = element("file-both", HTMLInputElement);
  both.accept = ACCEPT;
  both.addEventListener("change", () => {
    const [a, b] = both.files ?? [];
    if (a !== undefined) openFiles(b === undefined ? { a } : { a, b });
    both.value = "";
  });
}

/** The sources that files are, A's first. */
export const sourcesOf = (files: Sides<File>): Sides<Source> =>
  Object.fromEntries(Object.entries(files).map(([side, file]) => [side, { file }]));

/**
 * Opens the shapes that a state of the page names, without a state the first
 * pair; returns whether there is anything to open.
 */
export function openShapes(state?: string): boolean {
  if (state === undefined) {
    pair.dispatchEvent(new Event("change"));
    return true;
  }
  const parameters = new URLSearchParams(state);
  const sources: Sides<Source> = {};
  for (const side of SIDES) {
    const named = parameters.get(side) ?? OTHER;
    const known = [...lists[side].options].some(({ value }) => value === named);
    if (known && named !== OTHER && named !== shown[side]) sources[side] = { shape: named };
    // The page always shows two models.
    else if (shown[side] === undefined) sources[side] = { shape: presets[0]?.[side] ?? named };
  }
  if (Object.keys(sources).length === 0) return false;
  awaited = undefined;
  open(sources, IN_PLACE);
  return true;
}

/** Fills the lists of shapes. */
export function fillShapes(shapes: ShapeInfo[]): void {
  for (const list of Object.values(lists)) {
    list.replaceChildren(
      ...shapes.map(({ name, title }) => new Option(title, name)),
      otherOption(""),
    );
  }
}

/** Shows or hides the note that models are being loaded, or what for, which takes a while for large files. */
export function setLoading(loading: boolean, text = "loading…"): void {
  element("loading").hidden = !loading;
  element("load-cancel").hidden = !loading;
  element("loading").textContent = text;
}

/** Selects the entries of the lists that name the models shown, and allows what they propose. */
export function showSources(models: Sides<DisplayModel>, placement: Placement): void {
  if (awaited !== undefined) propose(awaited.limit);
  awaited = undefined;
  for (const side of SIDES) {
    const model = models[side];
    if (model === undefined) continue;
    const { source, faceCount } = model;
    const list = lists[side];
    list.value = "shape" in source ? source.shape : OTHER;
    shown[side] = list.value;
    if ("file" in source) {
      const option = list.querySelector<HTMLOptionElement>(`option[value="${OTHER}"]`);
      if (option) option.textContent = source.file.name;
    }
    list.title = `${faceCount} ${faceCount === 1 ? "face" : "faces"}`;
  }
  const index = presets.findIndex(
    (preset) =>
      preset.a === lists.a.value &&
      preset.b === lists.b.value &&
      samePlacement(preset.placement, placement),
  );
  pair.value = index < 0 ? OTHER : `${index}`;
}

/** Compares by value, as the worker returns copies of placements. */
const samePlacement = (one: Placement, two: Placement): boolean =>
  `${one.move} ${one.turn}` === `${two.move} ${two.turn}`;

function otherOption(title: string): HTMLOptionElement {
  const option = new Option(title, OTHER);
  option.hidden = true;
  return option;
}
