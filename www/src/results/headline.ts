// What the card says first: the distance beside what is allowed, in the same digits.
import type { Allowed } from "../scene/colors/scale.ts";
import type { Verdict } from "./judgement.ts";

/**
 * Returns what follows the distance on the card, such as `> 0.200 allowed`. `text` is the distance
 * as it is shown: a number that its interval holds, so that it is on the side of the limit that the
 * verdict says.
 */
export function comparedText(
  text: string,
  { above, below }: Allowed,
  verdict: Verdict | undefined,
): string {
  const decimals = /\.(\d+)/.exec(text)?.[1]?.length ?? 0;
  if (above !== below) {
    return `, +${inDigits(above, decimals)}/−${inDigits(below, decimals)} allowed`;
  }
  const allowed = `${inDigits(above, decimals)} allowed`;
  const distance = Number(text.replace(/^≤ /, ""));
  if (verdict === "pass" && distance <= above) return `≤ ${allowed}`;
  if (verdict === "fail" && distance > above) return `> ${allowed}`;
  return `, ${allowed}`;
}

/** A number with so many decimals, unless it has more: what is allowed is never rounded. */
function inDigits(value: number, decimals: number): string {
  const text = value.toFixed(Math.min(decimals, 15));
  return Number(text) === value ? text : `${value}`;
}
