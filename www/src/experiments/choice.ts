// What the user chose in the panel of the experiments.
import type { ShapeInfo } from "nurbs-hausdorff";
import { onDrop } from "../drop.ts";
import { element } from "../elements.ts";
import { SIDES, type Side, type Sides, type Source } from "../protocol.ts";
import * as methodList from "./method-list.ts";
import { type Entry, methods } from "./methods.ts";
import { type Pair, type Part, pairs } from "./pairs.ts";
import type { Plan } from "./sweep.ts";

const select = (id: string) => element(id, HTMLSelectElement);

const pair = select("pair");
const [count, samples] = [select("positions"), select("samples")];
const [limit, budget] = [select("limit"), select("budget")];
const files: Sides<File> = {};
let titles: ReadonlyMap<string, string> = new Map();

/** Fills the lists, and follows the files. */
export function offer(): void {
  pair.append(...pairs.map(({ name, title }) => new Option(title, name)));
  pair.addEventListener("change", tellModels);
  methodList.offer(entries());
  for (const side of SIDES) {
    const input = element(`file-${side}`, HTMLInputElement);
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) take({ [side]: file });
      // The same file, changed meanwhile, may be chosen again.
      input.value = "";
    });
  }
  onDrop(take);
  tellModels();
}

/** Names the models by the shapes' titles from now on. */
export function nameShapes(shapes: readonly ShapeInfo[]): void {
  titles = new Map(shapes.map(({ name, title }) => [name, title]));
  tellModels();
}

export function plan(): Plan {
  return {
    pair: chosenPair(),
    methods: entries().filter(({ name }) => methodList.isChosen(name)),
    count: Number(count.value),
    limit: Number(limit.value),
  };
}

/** The pair's models, or undefined where a file is wanting. */
export function sources(): Required<Sides<Source>> | undefined {
  const [a, b] = [source("a"), source("b")];
  return a === undefined || b === undefined ? undefined : { a, b };
}

/** A shape stands aside for the user's file; one file alone is both models where both are the same. */
function source(side: Side): Source | undefined {
  const { parts } = chosenPair();
  const other = side === "a" ? "b" : "a";
  const part = parts?.[side];
  const alike = part?.standsFor === parts?.[other].standsFor;
  const file = files[side] ?? (alike ? files[other] : undefined);
  if (part === undefined) return file && { file };
  if (part.standsFor === undefined || file === undefined) return { shape: part.shape };
  return { file, firstSurface: part.firstSurface };
}

/** Every method, chosen or not. */
export const entries = (): Entry[] =>
  methods({ samples: Number(samples.value), memoryBudget: Number(budget.value) });

function chosenPair(): Pair {
  const found = pairs.find(({ name }) => name === pair.value);
  if (found === undefined) throw new Error(`there is no pair ${pair.value}`);
  return found;
}

function take(dropped: Sides<File>): void {
  Object.assign(files, dropped);
  const { parts } = chosenPair();
  const fixed = parts && SIDES.some((side) => parts[side].standsFor === undefined);
  if (fixed) pair.value = pairs.find(({ parts }) => parts === undefined)?.name ?? "";
  tellModels();
}

/** Says what A and B are in the chosen pair. */
function tellModels(): void {
  for (const side of SIDES) {
    const name = element(`name-${side}`);
    name.textContent = describe(source(side), chosenPair().parts?.[side]);
    name.title = name.textContent;
  }
}

function describe(source: Source | undefined, part: Part | undefined): string {
  if (source === undefined) return "no file";
  if ("file" in source) return `${source.file.name}${source.firstSurface ? ", first surface" : ""}`;
  const title = titles.get(source.shape) ?? source.shape;
  return part?.standsFor === undefined ? title : `${title}, for ${part.standsFor}.json`;
}
