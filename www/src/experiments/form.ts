// The form of the experiments: the pair, the methods and the settings.

import type { ShapeInfo } from "nurbs-hausdorff";
import { onFilesDropped, sidesOf } from "../common/drop.ts";
import { element } from "../common/elements.ts";
import { ACCEPT } from "../files/formats.ts";
import { texts } from "../texts/index.ts";
import { SIDES, type Side, type Sides, type Source } from "../worker/protocol.ts";
import * as methodList from "./methodList.ts";
import { type Entry, methods } from "./sweep/methods.ts";
import { type Pair, type Part, pairs } from "./sweep/pairs.ts";
import type { Plan } from "./sweep/sweep.ts";

const select = (id: string) => element(id, HTMLSelectElement);

const pair = select("pair");
const [count, samples] = [select("positions"), select("samples")];
const [limit, budget] = [select("limit"), select("budget")];
const files: Sides<File> = {};
let titles: ReadonlyMap<string, string> = new Map();

/** Fills the lists and listens for files. */
export function fill(): void {
  pair.append(...pairs.map(({ name, title }) => new Option(title, name)));
  pair.addEventListener("change", showModels);
  methodList.fill(entries());
  for (const side of SIDES) {
    const input = element(`file-${side}`, HTMLInputElement);
    input.accept = ACCEPT;
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) takeFiles({ [side]: file });
      // Otherwise choosing the same file again, after an edit, raises no event.
      input.value = "";
    });
  }
  onFilesDropped((files, place) => {
    const sides = sidesOf(files, place);
    if (sides !== undefined) takeFiles(sides);
  });
  showModels();
}

/** Sets the titles by which shapes are named. */
export function setShapeTitles(shapes: readonly ShapeInfo[]): void {
  titles = new Map(shapes.map(({ name, title }) => [name, title]));
  showModels();
}

/** Returns the sweep that the form describes. */
export function plan(): Plan {
  return {
    pair: chosenPair(),
    methods: entries().filter(({ name }) => methodList.isChosen(name)),
    count: Number(count.value),
    limit: Number(limit.value),
  };
}

/** Returns the sources of both models, or undefined if a file is missing. */
export function sources(): Required<Sides<Source>> | undefined {
  const [a, b] = [source("a"), source("b")];
  return a === undefined || b === undefined ? undefined : { a, b };
}

/** A file replaces the shape that substitutes for it; a single file is used for both models of a pair of equal ones. */
function source(side: Side): Source | undefined {
  const { parts } = chosenPair();
  const other = side === "a" ? "b" : "a";
  const part = parts?.[side];
  const equal = part?.substituteFor === parts?.[other].substituteFor;
  const file = files[side] ?? (equal ? files[other] : undefined);
  if (part === undefined) return file && { file };
  if (part.substituteFor === undefined || file === undefined) return { shape: part.shape };
  return { file, firstSurface: part.firstSurface };
}

/** Returns all methods, chosen or not. */
export const entries = (): Entry[] =>
  methods({ samples: Number(samples.value), memoryBudget: Number(budget.value) });

function chosenPair(): Pair {
  const found = pairs.find(({ name }) => name === pair.value);
  if (found === undefined) throw new Error(`there is no pair ${pair.value}`);
  return found;
}

function takeFiles(chosen: Sides<File>): void {
  Object.assign(files, chosen);
  const { parts } = chosenPair();
  const fixed = parts && SIDES.some((side) => parts[side].substituteFor === undefined);
  if (fixed) pair.value = pairs.find(({ parts }) => parts === undefined)?.name ?? "";
  showModels();
}

/** Shows the names of A and B in the chosen pair. */
function showModels(): void {
  for (const side of SIDES) {
    const name = element(`name-${side}`);
    name.textContent = describe(source(side), chosenPair().parts?.[side]);
    name.title = name.textContent;
  }
}

function describe(source: Source | undefined, part: Part | undefined): string {
  if (source === undefined) return texts.experiments.noFile;
  if ("file" in source)
    return `${source.file.name}${source.firstSurface ? texts.experiments.firstSurface : ""}`;
  const title = titles.get(source.shape) ?? source.shape;
  return part?.substituteFor === undefined
    ? title
    : texts.experiments.inPlaceOf(title, part.substituteFor);
}
