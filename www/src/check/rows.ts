// The rows of a check's lists: pairs of bodies, and bodies with a fault.

import type { BodyPair, CheckedBody, UnkeptRule } from "nurbs-hausdorff";
import { make, span } from "../common/elements.ts";
import { texts } from "../texts/index.ts";
import { addRule } from "./rules.ts";
import { pairText, shortName, unkeptText } from "./words.ts";

/** What rows are of: whether of both models together, and the scene's units in one of the check's. */
export interface RowsOf {
  isOfBoth: boolean;
  scale: number;
}

/** A row of two bodies; `press` gets what the view says of their place. */
export function pairRow(
  pair: BodyPair,
  { isOfBoth, scale }: RowsOf,
  press: (button: HTMLButtonElement, label: string) => void,
): HTMLElement {
  const size = pairText(pair, scale);
  const { item, button } = row(
    pair.intended
      ? texts.bodies.stateMeant(texts.bodies.states[pair.state])
      : texts.bodies.states[pair.state],
    [pair.a, pair.b].map((name) => shortName(name, isOfBoth)),
    size,
  );
  button.title = texts.bodies.pairOf(pair.a, pair.b);
  button.dataset.state = pair.intended ? "meant" : pair.state;
  // What is judged, and may be meant all the same.
  if (pair.state === "clash" && !pair.intended) item.append(meantButton(pair));
  button.addEventListener("click", () =>
    press(
      button,
      pair.state === "clash"
        ? texts.bodies.states.clash
        : `${texts.bodies.states[pair.state]}, ${size}`,
    ),
  );
  return item;
}

/** A row of a body and what is wrong with it. */
export function bodyRow(
  body: CheckedBody,
  faults: readonly string[],
  { isOfBoth }: RowsOf,
  press: (button: HTMLButtonElement) => void,
): HTMLElement {
  const { item, button } = row(undefined, [shortName(body.name, isOfBoth)], faults.join(", "));
  button.title = body.name;
  button.addEventListener("click", () => press(button));
  return item;
}

/** A button that makes a rule of a clash that is meant. */
function meantButton({ a, b }: BodyPair): HTMLElement {
  const button = make("button", texts.bodies.isMeant, {
    ...{
      type: "button",
      class: "meant",
      title: texts.bodies.addsARuleAndIs,
    },
    "aria-label": texts.bodies.clashIsMeant(a, b),
  });
  button.addEventListener("click", () => addRule({ kind: "intended", a, b }));
  return button;
}

/** A row of a rule that is not certainly kept. */
export function ruleRow(rule: UnkeptRule, { isOfBoth, scale }: RowsOf): HTMLElement {
  const names = rule.rule === "mustTouch" ? [rule.a] : [rule.a, rule.b];
  const shown = names.map((name) => shortName(name, isOfBoth)).join(texts.bodies.and);
  const item = make("li", [span("name", shown), span("size", unkeptText(rule, scale))]);
  item.dataset.broken = `${rule.broken}`;
  item.title = texts.bodies.pairOf(rule.a, rule.b);
  return item;
}

function row(state: string | undefined, names: readonly string[], size: string) {
  const item = document.createElement("li");
  const button = document.createElement("button");
  button.type = "button";
  button.setAttribute("aria-pressed", "false");
  button.append(
    ...(state === undefined ? [] : [span("state", state)]),
    span("name", names.join(texts.bodies.and)),
    span("size", size),
  );
  item.append(button);
  return { item, button };
}
