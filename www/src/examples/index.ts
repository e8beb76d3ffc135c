// The parts that the page makes itself, by the names with which shapes are opened.
import type { InterchangeModel, ShapeInfo } from "nurbs-hausdorff";
import { BRACKET, bracket, REVISED } from "./bracket.ts";

const EXAMPLES: Readonly<Record<string, { title: string; model: () => InterchangeModel }>> = {
  bracket: { title: "Bracket", model: () => bracket("bracket", BRACKET) },
  "bracket-revised": {
    title: "Bracket, revised",
    model: () => bracket("bracket, revised", REVISED),
  },
};

/** The names and titles of the parts. */
export const examples: readonly ShapeInfo[] = Object.entries(EXAMPLES).map(([name, { title }]) => ({
  name,
  title,
}));

/** Returns the part of this name; undefined where there is none. */
export const example = (name: string): InterchangeModel | undefined => EXAMPLES[name]?.model();
