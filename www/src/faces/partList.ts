// The list of parts that are not the same in both revisions.

import { element, fillList, span } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { texts } from "../texts/index.ts";
import type { PlacedPart } from "../worker/protocol.ts";
import { detailText, partName, partsSummary, WORDS } from "./partWords.ts";

/** Parts listed; more are counted. */
const MAX_PARTS = 200;

const summary = element("part-summary");
const list = element("part-list");

/** Shows what became of the parts; calls `look` with one that is pressed, and without one when it is again. */
export function showParts(
  parts: readonly PlacedPart[],
  diagonal: number,
  look: (part: PlacedPart | undefined) => void,
): void {
  const others = parts.filter(({ state }) => state !== "same");
  summary.textContent = parts.length === 0 ? "" : partsSummary(parts);
  summary.hidden = parts.length === 0;
  list.hidden = others.length === 0;
  fillList(list, others, MAX_PARTS, (part) => row(part, diagonal, look));
}

/** The same as a table; none where there are no parts. */
export function partTables(parts: readonly PlacedPart[], diagonal: number): ReportTable[] {
  if (parts.length === 0) return [];
  const rows = parts
    .filter(({ state }) => state !== "same")
    .map((part) => [
      part.nameOfA ?? part.nameOfB ?? "",
      WORDS[part.state],
      detailText(part, diagonal),
    ]);
  return [{ title: partsSummary(parts), head: [texts.faces.part, texts.faces.state, ""], rows }];
}

function row(
  part: PlacedPart,
  diagonal: number,
  look: (part: PlacedPart | undefined) => void,
): HTMLElement {
  const item = document.createElement("li");
  const button = document.createElement("button");
  button.type = "button";
  button.dataset.state = part.state;
  button.setAttribute("aria-pressed", "false");
  button.title = [part.nameOfA, part.nameOfB].filter((name) => name !== null).join(" → ");
  button.append(
    span("name", partName(part)),
    span("state", WORDS[part.state]),
    span("detail", detailText(part, diagonal)),
  );
  button.addEventListener("click", () => {
    const isPressed = button.getAttribute("aria-pressed") === "true";
    for (const one of list.querySelectorAll("button")) one.setAttribute("aria-pressed", "false");
    button.setAttribute("aria-pressed", `${!isPressed}`);
    look(isPressed ? undefined : part);
  });
  item.append(button);
  return item;
}
