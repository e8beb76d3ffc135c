// The rules in the panel of the check: read from a file that is chosen or dropped, listed, removed, saved.

import { effect } from "@preact/signals-core";
import { element, make } from "../common/elements.ts";
import { download } from "../export/download.ts";
import { texts } from "../texts/index.ts";
import { clearRules, KINDS, type Rule, readRules, removeRule, rules, rulesText } from "./rules.ts";

const chosen = element("rules-file", HTMLInputElement);
const problem = element("rules-problem");

/** Connects the list of rules. */
export function connectRules(): void {
  effect(() => show(rules.value));
  chosen.addEventListener("change", () => {
    const file = chosen.files?.[0];
    // Otherwise choosing the same file again, after an edit, raises no event.
    chosen.value = "";
    if (file !== undefined) void read(file);
  });
  const zone = element("rules");
  zone.addEventListener("drop", (event) => {
    const file = event.dataTransfer?.files[0];
    if (file === undefined) return;
    // It is no model.
    event.preventDefault();
    event.stopPropagation();
    element("drop").hidden = true;
    void read(file);
  });
  element("rules-clear").addEventListener("click", clearRules);
  element("rules-save").addEventListener("click", () =>
    download("rules.json", new Blob([rulesText()], { type: "application/json" })),
  );
}

async function read(file: File): Promise<void> {
  try {
    readRules(await file.text());
    problem.textContent = "";
  } catch (error) {
    const why = error instanceof Error ? error.message : `${error}`;
    problem.textContent = `${file.name}: ${why}`;
  }
}

function show(all: readonly Rule[]): void {
  problem.textContent = "";
  element("rule-list").replaceChildren(...all.map(row));
  for (const id of ["rules-clear", "rules-save"]) element(id).hidden = all.length === 0;
  element("rules-none").hidden = all.length > 0;
}

/** What a rule asks of a pair. */
export function ruleText({ kind, a, b, distance }: Rule): string {
  const least = distance === undefined ? "" : texts.bodies.by(distance);
  return `${KINDS[kind].title}${least}: ${a} ${KINDS[kind].between} ${b}`;
}

function row(rule: Rule, index: number): HTMLElement {
  const { kind, a, b, distance } = rule;
  const remove = make("button", "×", {
    ...{ type: "button", title: texts.bodies.removeThisRule },
    "aria-label": texts.bodies.removeTheRule(ruleText(rule)),
  });
  remove.addEventListener("click", () => removeRule(index));
  const title = `${KINDS[kind].title}${distance === undefined ? "" : texts.bodies.byAtLeast(distance)}`;
  return make("li", [
    make("span", title, { class: "state" }),
    make("span", `${a} · ${b}`, { class: "name" }),
    remove,
  ]);
}
