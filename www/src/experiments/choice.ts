// What the user chose in the panel of the experiments.
import { onDrop } from "../drop.ts";
import { element } from "../elements.ts";
import { SIDES, type Sides, type Source } from "../protocol.ts";
import * as methodList from "./method-list.ts";
import { type Entry, methods } from "./methods.ts";
import { type Pair, pairs } from "./pairs.ts";
import type { Plan } from "./sweep.ts";

const select = (id: string) => element(id, HTMLSelectElement);

const pair = select("pair");
const [count, samples] = [select("positions"), select("samples")];
const [limit, budget] = [select("limit"), select("budget")];
const files: Sides<File> = {};

/** Fills the lists, and follows the files. */
export function offer(): void {
  pair.append(...pairs.map(({ name, title }) => new Option(title, name)));
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
}

export function plan(): Plan {
  return {
    pair: chosenPair(),
    methods: entries().filter(({ name }) => methodList.isChosen(name)),
    count: Number(count.value),
    limit: Number(limit.value),
  };
}

/** The pair's models, or undefined where a file is wanting; one file alone is both. */
export function sources(): Required<Sides<Source>> | undefined {
  const ours = chosenPair().sources;
  if (ours !== undefined) return ours();
  const { a = files.b, b = files.a } = files;
  return a === undefined || b === undefined ? undefined : { a: { file: a }, b: { file: b } };
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
  for (const side of SIDES) {
    const file = files[side];
    if (file !== undefined) element(`name-${side}`).textContent = file.name;
  }
  pair.value = pairs.find(({ sources }) => sources === undefined)?.name ?? "";
}
