// Selection of the models: the lists of pairs and shapes, and files.

import type { ShapeInfo } from "nurbs-hausdorff";
import { onFilesDropped, sidesOf } from "../common/drop.ts";
import { element } from "../common/elements.ts";
import { ACCEPT } from "../files/formats.ts";
import { allowed, setAllowed } from "../results/verdict.ts";
import { texts } from "../texts/index.ts";
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

/** What the user opens. */
export interface Opened {
  sources: Sides<Source>;
  placement: Placement;
  /** The files, in the order in which they were given. */
  files: readonly File[];
}

/** The shapes shown, and the entry of their pair. */
const shown: Sides<string> = {};
let shownPair = OTHER;
let open: (opened: Opened) => void = () => {};
/** The allowed deviation that an example began with, until the user changes it. */
let proposed: number | undefined;
/** What the models that are being opened propose, and the model that they leave without a file. */
let awaited: { limit?: number | undefined; aside?: Side | undefined } | undefined;
/** The model that is not compared: one file was dropped, and the other one was an example's. */
let aside: Side | undefined;
/** The model that the next single file is for where either may be meant. */
let next: Side = "a";

/** Allows what an example states; models of the user are not judged by an example's. */
function propose(limit: number | undefined): void {
  if (proposed === undefined && limit === undefined) return;
  const isProposed = allowed()?.above === proposed;
  if (limit !== undefined || isProposed) setAllowed(limit);
  proposed = limit;
}

/** The model that waits for a file, and is not compared meanwhile. */
export const asideSide = (): Side | undefined => aside;

/** Leaves a model without a file, because nothing is known of what it is compared with. */
export function leaveAside(side: Side | undefined): void {
  awaited = { ...awaited, aside: side };
}

/** Calls back with the models that the user selects. Only presets move A; other models keep their positions. */
export function onSource(listener: (opened: Opened) => void): void {
  open = listener;
  pair.append(
    ...presets.map(({ title }, index) => new Option(title, `${index}`)),
    otherOption(texts.files.ownPair),
  );
  pair.addEventListener("change", () => {
    const preset = presets[Number(pair.value)];
    if (preset === undefined) return;
    const sources = { a: { shape: preset.a }, b: { shape: preset.b } };
    openAll({ sources, placement: preset.placement, files: [] }, { limit: preset.allowed });
  });
  for (const side of SIDES) {
    lists[side].addEventListener("change", () => {
      openAll({
        sources: { [side]: { shape: lists[side].value } },
        placement: IN_PLACE,
        files: [],
      });
    });
    const input = element(`file-${side}`, HTMLInputElement);
    input.accept = ACCEPT;
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) openFiles([file], side);
      // Otherwise choosing the same file again, after an edit, raises no event.
      input.value = "";
    });
  }
  onFilesDropped(dropFiles, element("dropzone"));
  const both = element("file-both", HTMLInputElement);
  both.accept = ACCEPT;
  both.addEventListener("change", () => {
    dropFiles([...(both.files ?? [])], undefined);
    both.value = "";
  });
}

/** Opens files that are given for a comparison: nothing else is compared with a single one. */
function dropFiles(files: readonly File[], place: Side | undefined): void {
  const side = place ?? aside ?? next;
  if (files.length === 1) next = other(side);
  // Of an example nobody asked what it is like.
  const isExample = pair.value !== OTHER && SIDES.every((one) => shown[one]);
  const waits = files.length === 1 && (isExample || aside === other(side));
  openFiles(files, side, waits ? other(side) : undefined);
}

function openFiles(files: readonly File[], place: Side, without?: Side): void {
  const sides = sidesOf(files, place);
  if (sides === undefined) return;
  openAll({ sources: sourcesOf(sides), placement: IN_PLACE, files }, { aside: without });
  const more = files.slice(2).map(({ name }) => name);
  note(more.length === 0 ? "" : texts.files.twoFilesAreComparedWas(more.join(", ")));
}

function openAll(opened: Opened, proposal: NonNullable<typeof awaited> = {}): void {
  note("");
  awaited = proposal;
  open(opened);
}

const other = (side: Side): Side => (side === "a" ? "b" : "a");

/** Says something of the files or the link that were given. */
export function note(text: string): void {
  element("files-note").textContent = text;
  element("files-note").hidden = text === "";
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
  open({ sources, placement: IN_PLACE, files: [] });
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
export function setLoading(loading: boolean, text = texts.files.loading): void {
  element("loading").hidden = !loading;
  element("load-cancel").hidden = !loading;
  element("loading").textContent = text;
}

/** Shows in the rows which models are being read, whose results are not there yet. */
export function showReading(sources: Sides<Source>): void {
  for (const side of SIDES) {
    const source = sources[side];
    if (source !== undefined) showName(side, source);
  }
  pair.value = OTHER;
}

/** Shows in the rows the files that a link is about: those that are not here yet, and the others. */
export function showMissing(missing: Sides<{ name: string }>, found: Sides<Source>): void {
  showReading(found);
  for (const side of SIDES) {
    const file = missing[side];
    if (file !== undefined) nameOther(side, texts.files.notHereYet(file.name));
  }
}

/** Selects the entries of the lists that name the models shown, and allows what they propose. */
export function showSources(models: Sides<DisplayModel>, placement: Placement): void {
  if (awaited !== undefined) propose(awaited.limit);
  // What was left without a file has one now, unless it is another one's that is left.
  if (awaited?.aside !== undefined) aside = awaited.aside;
  else if (aside !== undefined && models[aside] !== undefined) aside = undefined;
  awaited = undefined;
  showNames(models);
  const index = presets.findIndex(
    (preset) =>
      preset.a === lists.a.value &&
      preset.b === lists.b.value &&
      samePlacement(preset.placement, placement),
  );
  shownPair = index < 0 ? OTHER : `${index}`;
  pair.value = shownPair;
}

/** Shows the names of models again, because those that were read instead are not there. */
export function showNames(models: Sides<DisplayModel>): void {
  pair.value = shownPair;
  for (const side of SIDES) {
    const model = models[side];
    if (side === aside) {
      nameOther(side, texts.files.noFileYet);
      shown[side] = OTHER;
    } else if (model !== undefined) {
      showName(side, model.source);
      shown[side] = lists[side].value;
      const { faceCount } = model;
      lists[side].title = texts.files.faces(`${faceCount}`, faceCount);
    }
  }
}

function showName(side: Side, source: Source): void {
  if ("shape" in source) lists[side].value = source.shape;
  else nameOther(side, source.file.name);
}

/** Shows a name that is none of the list. */
function nameOther(side: Side, name: string): void {
  const option = lists[side].querySelector<HTMLOptionElement>(`option[value="${OTHER}"]`);
  if (option) option.textContent = name;
  lists[side].value = OTHER;
}

/** Compares by value, as the worker returns copies of placements. */
const samePlacement = (one: Placement, two: Placement): boolean =>
  `${one.move} ${one.turn}` === `${two.move} ${two.turn}`;

function otherOption(title: string): HTMLOptionElement {
  const option = new Option(title, OTHER);
  option.hidden = true;
  return option;
}
