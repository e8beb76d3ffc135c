// What the user wants of the report: paper, logo, and what is in it. They are kept in this browser, as they are of a
// workplace and not of a pair of models.

import { effect, signal } from "@preact/signals-core";
import { element } from "../../common/elements.ts";
import { keep, kept } from "../../state/workplace.ts";
import { texts } from "../../texts/index.ts";
import { dataUrl } from "../download.ts";
import type { Paper } from "./style.ts";

/** The parts of a report that can be left out; the verdict and the files are in all. */
export type Section =
  | ("views" | "places" | "histogram" | "faces" | "points" | "tables")
  | "settings";

/** The largest picture of a logo, in bytes. */
const MAX_LOGO = 500_000;

const paper = element("report-paper", HTMLSelectElement);
const chosen = element("report-logo", HTMLInputElement);
const shown = element("report-logo-shown", HTMLImageElement);
const picture = signal(kept("logo") ?? "");
const boxes = [
  ...element("report-sections").querySelectorAll<HTMLInputElement>("input[type=checkbox]"),
];

/** The paper that the report is for. */
export const chosenPaper = (): Paper => (paper.value === "letter" ? "letter" : "A4");

/** Whether the report has a part. */
export const hasSection = (section: Section): boolean =>
  boxes.find(({ value }) => value === section)?.checked ?? true;

/** The address of the logo; undefined without one. */
export const logo = (): string | undefined => picture.peek() || undefined;

/** Connects the controls; `refuse` gets why a picture is none. */
export function connectReportSettings(refuse: (why: string) => void): void {
  if (kept("paper") === "letter") paper.value = "letter";
  paper.addEventListener("input", () => keep("paper", paper.value));
  const without = (kept("left-out") ?? "").split(" ");
  for (const box of boxes) {
    box.checked = !without.includes(box.value);
    box.addEventListener("input", () => {
      const left = boxes.filter(({ checked }) => !checked).map(({ value }) => value);
      keep("left-out", left.join(" "));
    });
  }
  effect(() => {
    const address = picture.value;
    shown.hidden = address === "";
    element("report-logo-clear").hidden = address === "";
    if (address !== "") shown.src = address;
    keep("logo", address);
  });
  element("report-logo-clear").addEventListener("click", () => {
    picture.value = "";
  });
  chosen.addEventListener("change", async () => {
    const file = chosen.files?.[0];
    chosen.value = "";
    if (file === undefined) return;
    const isPicture = file.type.startsWith("image/");
    if (isPicture && file.size <= MAX_LOGO) picture.value = await dataUrl(file);
    else refuse(texts.report.isNoPictureOfAt(file.name, MAX_LOGO / 1000));
  });
}
