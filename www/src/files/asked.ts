// The files that a link names and that are not here: the page asks for them, and shows nothing before.

import { element } from "../common/elements.ts";
import { texts } from "../texts/index.ts";
import { SIDES, type Sides, type Source } from "../worker/protocol.ts";
import { type FileName, isNamed, nameOf, shortHash } from "./identity.ts";

const note = element("asked");
const text = element("asked-text");
const problem = element("asked-problem");

export class AskedFiles {
  #wanted: Sides<FileName> = {};
  #found: Sides<Source> = {};

  readonly #onMissing: (missing: Sides<FileName>, found: Sides<Source>) => void;

  /**
   * Calls back with the files that are not here yet and with the others, and when the user wants something else than the
   * files of the link.
   */
  constructor(
    onMissing: (missing: Sides<FileName>, found: Sides<Source>) => void,
    onEnd: () => void,
  ) {
    this.#onMissing = onMissing;
    element("asked-end").addEventListener("click", () => {
      this.end();
      onEnd();
    });
  }

  /** Whether files are asked for. */
  get isActive(): boolean {
    return !note.hidden;
  }

  /** Asks for the files that are named and not found. */
  ask(wanted: Sides<FileName>, found: Sides<Source>): void {
    this.#wanted = wanted;
    this.#found = found;
    problem.textContent = "";
    this.#draw();
  }

  /** Ends asking. */
  end(): void {
    note.hidden = true;
  }

  /** Takes files that the user opens; returns all sources once none is missing. */
  async take(files: readonly File[]): Promise<Sides<Source> | undefined> {
    const problems: string[] = [];
    for (const file of files) {
      const name = await nameOf(file);
      const side = SIDES.find((one) => {
        const wanted = this.#missing[one];
        return wanted !== undefined && isNamed(name, wanted);
      });
      if (side !== undefined) this.#found[side] = { file };
      else problems.push(this.#refusal(name));
    }
    problem.textContent = problems.join(" ");
    if (Object.keys(this.#missing).length > 0) {
      this.#draw();
      return undefined;
    }
    this.end();
    return this.#found;
  }

  get #missing(): Sides<FileName> {
    return Object.fromEntries(
      Object.entries(this.#wanted).filter(([side]) => this.#found[side as "a" | "b"] === undefined),
    );
  }

  /** Why a file is not taken. */
  #refusal({ name, hash }: FileName): string {
    const isSameName = Object.values(this.#missing).some((wanted) => wanted.name === name);
    return isSameName
      ? texts.files.hasAnotherContent(name, shortHash(hash))
      : texts.files.isNoFileOfTheLink(name);
  }

  #draw(): void {
    const called = ({ name, hash }: FileName) =>
      hash === "" ? name : `${name} (SHA-256 ${shortHash(hash)}…)`;
    const names = SIDES.flatMap((side) => this.#missing[side] ?? []).map(called);
    text.textContent = texts.files.theLinkIsAbout(names.join(texts.files.and), names.length);
    note.hidden = false;
    this.#onMissing(this.#missing, this.#found);
  }
}
