// The rules of a check: what is meant, and what must be, in a control of the form, so that links, undoing and
// kept files hold them. They are those of the command's `--rules`, as JSON.

import { computed } from "@preact/signals-core";
import type { CheckRules, NamesOfPair } from "nurbs-hausdorff";
import { field } from "../state/store.ts";
import { texts } from "../texts/index.ts";

/** The kinds of rules, with what is said of a pair. */
export const KINDS = {
  intended: texts.bodies.ruleMeant,
  mustTouch: texts.bodies.ruleMustTouch,
  atLeast: texts.bodies.ruleApart,
};

export type Kind = keyof typeof KINDS;

/** One rule of a file. */
export interface Rule extends NamesOfPair {
  kind: Kind;
  /** Of `atLeast`, in model units. */
  distance?: number;
}

/** The longest text of rules: a link holds it. */
const MAX_TEXT = 20_000;

const state = field("check-rules");

/** All rules, in the order of their kinds. */
export const rules = computed((): readonly Rule[] => {
  try {
    return state.value === "" ? [] : rulesOf(state.value);
  } catch {
    // An address may hold anything.
    return [];
  }
});

/** The rules as a check takes them; undefined without any. */
export function checkRules(): CheckRules | undefined {
  const all = rules.value;
  return all.length === 0 ? undefined : (grouped(all) as CheckRules);
}

/**
 * Reads the text of a file of rules.
 *
 * @throws {Error} that says what was found and what is expected.
 */
export function readRules(text: string): void {
  if (text.length > MAX_TEXT) throw new Error(texts.bodies.theRulesAreLongerThan(MAX_TEXT));
  write(rulesOf(text));
}

/** Adds a rule, unless it is there. */
export function addRule(rule: Rule): void {
  const isSame = (one: Rule) => JSON.stringify(one) === JSON.stringify(rule);
  if (!rules.value.some(isSame)) write([...rules.value, rule]);
}

export const removeRule = (index: number): void =>
  write(rules.value.filter((_, other) => other !== index));

export const clearRules = (): void => state.set("");

/** The text of a file with these rules. */
export const rulesText = (): string => JSON.stringify(grouped(rules.value), undefined, 2);

function write(all: readonly Rule[]): void {
  state.set(all.length === 0 ? "" : JSON.stringify(grouped(all)));
}

function grouped(all: readonly Rule[]): Partial<Record<Kind, Omit<Rule, "kind">[]>> {
  const groups: Partial<Record<Kind, Omit<Rule, "kind">[]>> = {};
  for (const { kind, ...rule } of all) {
    const group = groups[kind] ?? [];
    group.push(rule);
    groups[kind] = group;
  }
  return groups;
}

function rulesOf(text: string): Rule[] {
  const parsed: unknown = JSON.parse(text);
  if (typeof parsed !== "object" || parsed === null || Array.isArray(parsed)) {
    throw new Error(texts.bodies.rulesAreAnObjectWith);
  }
  const unknown = Object.keys(parsed).find((key) => !(key in KINDS));
  if (unknown !== undefined) {
    throw new Error(texts.bodies.rulesHaveNoListThey(unknown));
  }
  return (Object.keys(KINDS) as Kind[]).flatMap((kind) => {
    const list: unknown = (parsed as Record<string, unknown>)[kind] ?? [];
    if (!Array.isArray(list)) throw new Error(texts.bodies.isNoList(kind));
    return list.map((rule, index) => ruleOf(kind, rule, texts.bodies.rule(kind, index + 1)));
  });
}

function ruleOf(kind: Kind, rule: unknown, where: string): Rule {
  const { a, b, distance, ...others } = (rule ?? {}) as Record<string, unknown>;
  if (typeof a !== "string" || typeof b !== "string") {
    throw new Error(texts.bodies.hasNoNames(where));
  }
  const [unknown] = Object.keys(others);
  if (unknown !== undefined) throw new Error(texts.bodies.hasWhichNoRuleHas(where, unknown));
  if (kind !== "atLeast") return { kind, a, b };
  if (typeof distance !== "number" || !(distance >= 0)) {
    throw new Error(texts.bodies.hasNoDistance(where));
  }
  return { kind, a, b, distance };
}
