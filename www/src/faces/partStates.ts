// What became of the parts that a level of the tree has.
import { texts } from "../texts/index.ts";
import type { PlacedPart, Side } from "../worker/protocol.ts";
import { WORDS } from "./partWords.ts";

export class PartStates {
  readonly isEmpty: boolean;
  readonly #parts: Record<Side, Map<number, PlacedPart>> = { a: new Map(), b: new Map() };

  constructor(parts: readonly PlacedPart[]) {
    this.isEmpty = parts.length === 0;
    for (const part of parts) {
      for (const side of ["a", "b"] as const) {
        for (const face of part.facesOf[side]) this.#parts[side].set(face, part);
      }
    }
  }

  /** The word of the part that has these faces; of several, how many of them are not the same. */
  of(side: Side, faces: readonly number[]): { text: string; title: string; isSame: boolean } {
    const parts = new Set(faces.flatMap((face) => this.#parts[side].get(face) ?? []));
    const [only] = parts;
    if (only === undefined) return { text: "", title: "", isSame: true };
    if (parts.size === 1)
      return { text: WORDS[only.state], title: "", isSame: only.state === "same" };
    const others = [...parts].filter(({ state }) => state !== "same").length;
    if (others === 0)
      return { text: WORDS.same, title: texts.faces.allParts(parts.size), isSame: true };
    return {
      text: texts.faces.differ(others),
      title: texts.faces.ofParts(parts.size),
      isSame: false,
    };
  }
}
