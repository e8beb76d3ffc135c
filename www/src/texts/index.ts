// The texts of the page in the language that is shown.
import { en } from "./en/index.ts";

/** What another language has to say: the same texts, and functions of the same values. */
export type Texts = typeof en;

export const texts: Texts = en;
