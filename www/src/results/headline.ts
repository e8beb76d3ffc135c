// What the card says first: the distance beside what is allowed, in the same digits.

import { shownLength } from "../common/text/numbers.ts";
import type { Allowed } from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { Verdict } from "./judgement.ts";

/** Decimals up to which a distance and what is allowed are compared digit by digit. */
const MAX_DECIMALS = 15;
/** The longest number that is typed: longer ones were converted. */
const MAX_LENGTH = 14;

/**
 * Returns what follows the distance on the card, such as `> 0.200 allowed`. `text` is the distance
 * as it is shown: a number that its interval holds, so that it is on the side of the limit that the
 * verdict says.
 */
export function comparedText(text: string, allowed: Allowed, verdict: Verdict | undefined): string {
  const [above, below] = [shownLength(allowed.above), shownLength(allowed.below)];
  const decimals = /\.(\d+)/.exec(text)?.[1]?.length ?? 0;
  if (above !== below) {
    return texts.results.allowedBothWays(inDigits(above, decimals), inDigits(below, decimals));
  }
  const limit = texts.results.allowedOne(inDigits(above, decimals));
  const distance = Number(text.replace(/^≤ /, ""));
  if (verdict === "pass" && distance <= above) return `≤ ${limit}`;
  if (verdict === "fail" && distance > above) return `> ${limit}`;
  return `, ${limit}`;
}

/**
 * A number with so many decimals, unless it has more: what is allowed is never rounded. One that
 * was converted to another unit has no end; dots say that there is more.
 */
function inDigits(value: number, decimals: number): string {
  const text = value.toFixed(Math.min(decimals, MAX_DECIMALS));
  if (Number(text) === value) return text;
  const own = `${value}`;
  if (own.length <= MAX_LENGTH) return own;
  const step = 10 ** (decimals + 1);
  return `${(Math.floor(value * step) / step).toFixed(decimals + 1)}…`;
}
