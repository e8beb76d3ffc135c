// The rows of a check's lists: pairs of bodies, and bodies with a fault.
import type { BodyPair, CheckedBody } from "nurbs-hausdorff";
import { span } from "../common/elements.ts";
import { pairText, shortName } from "./words.ts";

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
    pair.state,
    [pair.a, pair.b].map((name) => shortName(name, isOfBoth)),
    size,
  );
  button.title = `${pair.a} and ${pair.b}`;
  button.addEventListener("click", () =>
    press(button, pair.state === "clash" ? "clash" : `${pair.state}, ${size}`),
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

function row(state: string | undefined, names: readonly string[], size: string) {
  const item = document.createElement("li");
  const button = document.createElement("button");
  button.type = "button";
  button.setAttribute("aria-pressed", "false");
  button.append(
    ...(state === undefined ? [] : [span("state", state)]),
    span("name", names.join(" and ")),
    span("size", size),
  );
  if (state !== undefined) button.dataset.state = state;
  item.append(button);
  return { item, button };
}
