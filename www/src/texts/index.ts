// The texts of the page in the language that is shown. Another language is a folder beside `en` with the same names, of
// the types below, and is chosen here.
import { en } from "./en/index.ts";
import { pages } from "./en/page/index.ts";

/** What another language has to say: the same texts, and functions of the same values. */
export type Texts = typeof en;

/** What another language has to say before anything is done, which the HTML of pages names. */
export type PageTexts = typeof pages;

export const texts: Texts = en;

/** Put into the HTML when it is built. */
export const pageTexts: PageTexts = pages;
