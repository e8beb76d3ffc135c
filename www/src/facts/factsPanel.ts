// The panel of facts: volume, mass, area, extents and centroid of both models and of their bodies.

import { batch, effect, signal } from "@preact/signals-core";
import { element, span } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import {
  isNarrow,
  narrowText,
  quantityText,
  rangeText,
  wholeText,
} from "../common/text/quantities.ts";
import { commonUnit, metresPerUnit, unitScale } from "../files/units.ts";
import { field, sizeOf } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import { type FactsReply, type ModelFacts, SIDES, type Sides } from "../worker/protocol.ts";
import { type Subject, subjectsOf } from "./pairs.ts";
import {
  type Fact,
  type FactRow,
  type FactUnits,
  factRows,
  unitsSentence,
  unitsText,
} from "./rows.ts";

/** Bodies that can be chosen, and those of which the report has a table; a list of more is not read. */
const MAX_SUBJECTS = 300;
const MAX_TABLES = 20;

const section = element("facts-card");
const start = element("facts-start", HTMLButtonElement);
const state = element("facts-state");
const shown = element("facts-shown");
const choice = element("facts-of", HTMLSelectElement);
const density = field("density");
const intervals = element("facts-intervals", HTMLInputElement);
const table = element("facts-table", HTMLTableElement);
const hasIntervals = signal(intervals.checked);

export class FactsPanel {
  readonly #ask: () => void;
  #models: Sides<ModelFacts> = {};
  readonly #subjects = signal<readonly Subject[]>([]);
  readonly #chosen = signal(0);

  /** Calls `ask` when facts are wanted of the models as they are. */
  constructor(ask: () => void) {
    this.#ask = ask;
    start.addEventListener("click", () => this.#request());
    choice.addEventListener("input", () => {
      this.#chosen.value = Number(choice.value);
    });
    intervals.addEventListener("input", () => {
      hasIntervals.value = intervals.checked;
    });
    // Also by the density and in the unit that is shown, and whenever those change.
    effect(() => this.#draw(this.#subjects.value, this.#chosen.value));
  }

  #request(): void {
    section.dataset.state = "working";
    state.textContent = texts.bodies.computing;
    this.#ask();
  }

  /** Shows a reply; of a model that is not compared, nothing is shown. */
  show(reply: FactsReply, aside: keyof Sides<unknown> | undefined): void {
    section.dataset.state = reply.state;
    state.textContent = "";
    if (reply.state !== "done") {
      if (reply.state === "failed") state.textContent = `${reply.message} (${reply.code})`;
      return;
    }
    this.#models = { ...reply.models };
    if (aside !== undefined) delete this.#models[aside];
    const subjects = subjectsOf(this.#models).slice(0, MAX_SUBJECTS);
    choice.replaceChildren(...subjects.map(({ title }, index) => new Option(title, `${index}`)));
    element("facts-of-row").hidden = subjects.length < 2;
    shown.hidden = false;
    batch(() => {
      this.#chosen.value = 0;
      this.#subjects.value = subjects;
    });
  }

  /** Removes the facts of models that were replaced; those of the new ones are asked for where they were shown. */
  replaced(): void {
    const wasShown = section.dataset.state === "done" || section.dataset.state === "working";
    section.dataset.state = "idle";
    state.textContent = "";
    shown.hidden = true;
    this.#models = {};
    this.#subjects.value = [];
    if (wasShown) this.#request();
  }

  /** What the worker found of the models; none before it is asked. */
  get found(): Sides<ModelFacts> | undefined {
    return section.dataset.state === "done" ? this.#models : undefined;
  }

  /** The facts of the models and of the first bodies, each with its interval. */
  get tables(): ReportTable[] {
    if (this.found === undefined) return [];
    return this.#subjects
      .peek()
      .slice(0, MAX_TABLES)
      .map((subject, index) => ({
        title: index === 0 ? texts.bodies.factsOfTheFilesAs : texts.bodies.facts(subject.title),
        head: [unitsText(unitsNow()), "A", "B", "B − A"],
        rows: factRows(subject, unitsNow()).map(({ name, facts, difference }) => [
          name,
          ...[facts.a, facts.b, difference].map((fact) =>
            typeof fact === "object" ? wholeText(fact) : (fact ?? ""),
          ),
        ]),
      }));
  }

  #draw(subjects: readonly Subject[], chosen: number): void {
    const subject = subjects[chosen] ?? subjects[0];
    if (subject === undefined) return;
    const rows = factRows(subject, unitsNow());
    const sides = SIDES.filter((side) => this.#models[side] !== undefined);
    const isPair = sides.length === 2;
    const letters = sides.map((side) => {
      const head = cell("th", "");
      const letter = document.createElement("b");
      letter.className = side;
      letter.textContent = side.toUpperCase();
      head.append(letter);
      return head;
    });
    const head = document.createElement("tr");
    head.append(cell("td", ""), ...letters, ...(isPair ? [cell("th", "B − A")] : []));
    table.createTHead().replaceChildren(head);
    const body = table.tBodies[0] ?? table.createTBody();
    body.replaceChildren(...rows.flatMap((row) => tableRows(row, sides, isPair)));
    const note = element("units-differ");
    const unequal = note.hidden ? "" : ` ${note.textContent}`;
    element("facts-units").textContent = `${unitsSentence(unitsNow())}${unequal}`;
  }
}

/** The units and the density in which facts are shown now. */
function unitsNow(): FactUnits {
  const value = sizeOf(density.value) ?? 0;
  return {
    name: commonUnit(),
    scale: unitScale(),
    metres: metresPerUnit(),
    density: value > 0 ? value : undefined,
  };
}

/** A row of numbers, and where intervals are wanted one of these below it. */
function tableRows(
  { name, facts, difference, percent = "" }: FactRow,
  sides: readonly ("a" | "b")[],
  isPair: boolean,
): HTMLElement[] {
  const row = document.createElement("tr");
  const head = cell("th", name);
  head.scope = "row";
  const numbers = sides.map((side) => factCell(facts[side]));
  const change = factCell(difference ?? "");
  if (percent !== "") change.append(span("percent", percent));
  row.append(head, ...numbers, ...(isPair ? [change] : []));
  if (!hasIntervals.value) return [row];
  const texts = [
    ...sides.flatMap((side) => labelled(side.toUpperCase(), facts[side])),
    ...labelled("B − A", difference),
  ];
  if (texts.length === 0) return [row];
  const ranges = document.createElement("tr");
  ranges.className = "ranges";
  const all = cell("td", "");
  all.colSpan = sides.length + (isPair ? 2 : 1);
  all.append(
    ...texts.map((text) => {
      const line = document.createElement("span");
      line.textContent = text;
      return line;
    }),
  );
  ranges.append(all);
  return [row, ranges];
}

const labelled = (label: string, fact: Fact | undefined): string[] =>
  typeof fact === "object" ? [texts.bodies.labelIn(label, rangeText(fact))] : [];

function factCell(fact: Fact | undefined): HTMLTableCellElement {
  if (typeof fact !== "object") {
    const text = cell("td", fact ?? "");
    text.className = "wide";
    return text;
  }
  const node = cell("td", narrowText(fact));
  if (!isNarrow(fact)) node.className = "wide";
  node.title = texts.bodies.numberAndInterval(quantityText(fact), rangeText(fact));
  return node;
}

function cell(name: "th" | "td", text: string): HTMLTableCellElement {
  const node = document.createElement(name);
  node.textContent = text;
  return node;
}
