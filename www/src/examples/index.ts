// The parts that the page makes itself, by the names with which shapes are opened.

import type { InterchangeModel, ShapeInfo } from "nurbs-hausdorff";
import { texts } from "../texts/index.ts";
import { BRACKET, bracket, REVISED } from "./bracket.ts";

const EXAMPLES: Readonly<Record<string, { title: string; model: () => InterchangeModel }>> = {
  bracket: { title: texts.files.bracket, model: () => bracket("bracket", BRACKET) },
  "bracket-revised": {
    title: texts.files.bracketRevised,
    model: () => bracket(texts.files.bracketRevisedName, REVISED),
  },
};

/** The names and titles of the parts. */
export const examples: readonly ShapeInfo[] = Object.entries(EXAMPLES).map(([name, { title }]) => ({
  name,
  title,
}));

/** Returns the part of this name; undefined where there is none. */
export const example = (name: string): InterchangeModel | undefined => EXAMPLES[name]?.model();
