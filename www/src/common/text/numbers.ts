// Formatting of numbers.

import { signal } from "@preact/signals-core";
import { texts } from "../../texts/index.ts";

/** Decimal digits that float64 represents faithfully. */
const SIGNIFICANT_DIGITS = 15;
/** The largest argument that `toFixed` accepts. */
const MAX_DIGITS = 100;
/** The part of a number by which one that stands for it may differ from it, beside its rounding. */
const NEAR = 0.01;
/** Digits of a distance below the models' order of magnitude. */
const RELATIVE_DIGITS = 5;

/** What lengths are multiplied by where they are shown: effects that write lengths follow it. */
const factor = signal(1);
/** The relative rounding of a product in float64, and of what is added to stay outside of it. */
const ROUNDING = 2 ** -51;

/** Shows lengths in a unit of which one of the models' units has so many. */
export function setShownFactor(shownUnits: number): void {
  factor.value = shownUnits;
}

/** A length of the models in the unit in which lengths are shown. */
export const shownLength = (length: number): number => length * factor.value;

/** An interval in the unit shown: wider by the rounding of that, or with `inside` narrower. */
function shownInterval(lower: number, upper: number, inside = false): [number, number] {
  if (factor.value === 1) return [lower, upper];
  const [low, high] = [shownLength(lower), shownLength(upper)];
  const side = inside ? -1 : 1;
  const ends: [number, number] = [low * (1 - side * ROUNDING), high * (1 + side * ROUNDING)];
  // An interval narrower than the rounding has no inside: either end is as near as float64 gets.
  return ends[0] <= ends[1] ? ends : [Math.min(low, high), Math.max(low, high)];
}

/**
 * A distance, to `RELATIVE_DIGITS` digits below the order of magnitude of the diagonal. One
 * that would read 0, and is no rounding of the models' size, has two significant digits.
 */
export function distanceText(length: number, modelDiagonal: number): string {
  const [distance, diagonal] = [shownLength(length), shownLength(modelDiagonal)];
  const size = magnitude(diagonal);
  const fixed = distance.toFixed(digitsAfterPoint(RELATIVE_DIGITS - size));
  const isSmall = Number(fixed) === 0 && Math.abs(distance) > 10 ** (size - SIGNIFICANT_DIGITS);
  return isSmall ? distance.toExponential(1) : fixed;
}

/** An upper bound to two significant digits, rounded up, such as 1.1e-11. */
export const upperText = (bound: number): string => short(bound, 1);

/** An upper bound to the digits of a distance of models of this size, rounded up; a small one to two digits. */
export function boundText(length: number, modelDiagonal: number): string {
  const [bound, diagonal] = [shownLength(length), shownLength(modelDiagonal)];
  const digits = digitsAfterPoint(RELATIVE_DIGITS - magnitude(diagonal));
  const step = 10 ** -digits;
  if (bound < step) return upperText(bound);
  const rounded = Number(bound.toFixed(digits));
  return (rounded < bound ? rounded + step : rounded).toFixed(digits);
}

/** A bound to two significant digits, rounded up or down. */
function short(bound: number, sign: -1 | 1): string {
  if (bound === 0) return "0";
  const step = 10 ** (Math.floor(Math.log10(bound)) - 1);
  const rounded = Number(bound.toPrecision(2));
  const safe = sign * (rounded - bound) < 0 ? rounded + sign * step : rounded;
  return Math.abs(Math.log10(safe)) < 3 ? `${Number(safe.toPrecision(2))}` : safe.toExponential(1);
}

/**
 * Whether an interval states only an upper bound: it is wider than its lower end
 * is large, and its upper end has fewer than two of the digits shown.
 */
const isUpperBound = (lower: number, upper: number, diagonal: number): boolean =>
  lower <= upper - lower && upper < 10 ** (magnitude(diagonal) - RELATIVE_DIGITS + 1);

/**
 * The distance in this interval, as a number that the interval holds: the fewest digits with which
 * one is near `computed`, at least those of the models' size as far as the interval is narrow enough
 * for them. Where the interval states only an upper bound it is that bound, such as ≤ 1.1e-11.
 */
export function certifiedText(
  found: number,
  interval: readonly [number, number],
  modelDiagonal: number,
): string {
  const [lower, upper] = shownInterval(...interval, true);
  const [computed, diagonal] = [shownLength(found), shownLength(modelDiagonal)];
  if (upper === 0) return "0";
  if (isUpperBound(lower, upper, diagonal)) {
    return `≤ ${upperText(shownInterval(...interval)[1])}`;
  }
  return heldNumber(computed, [lower, upper], RELATIVE_DIGITS - magnitude(diagonal));
}

/**
 * A number that an interval above 0 holds: the fewest digits with which one is near `computed`, at least
 * `wanted` behind the point as far as the interval is narrow enough for them.
 */
export function heldNumber(
  computed: number,
  [lower, upper]: readonly [number, number],
  wanted: number,
): string {
  const narrow = upper > lower ? Math.floor(-Math.log10(upper - lower)) : MAX_DIGITS;
  // A wide interval holds what was computed too: two of its digits say more than one.
  const known = Math.max(narrow, 1 - magnitude(computed));
  const first = digitsAfterPoint(Math.min(wanted, known));
  const last = digitsAfterPoint(SIGNIFICANT_DIGITS - 1 - magnitude(upper));
  const isHeld = (text: string) => lower <= Number(text) && Number(text) <= upper;
  for (let digits = first; digits <= last; digits++) {
    const step = 10 ** -digits;
    // In a wide interval a neighbour with few digits may be far from what was computed.
    const steps = step <= NEAR * computed ? [0, -step, step] : [0];
    const held = steps.map((by) => (computed + by).toFixed(digits)).find(isHeld);
    if (held !== undefined) return held;
  }
  // An interval between two neighbours of such numbers: its own end, with all its digits.
  return `${lower <= computed && computed <= upper ? computed : upper}`;
}

/** Digits after those of the models' size that a list has room for. */
const MORE_DIGITS = 2;

/** As `certifiedText` for lists: of many digits the first ones, with dots that say that there are more. */
export function listedText(
  computed: number,
  interval: readonly [number, number],
  diagonal: number,
): string {
  const text = certifiedText(computed, interval, diagonal);
  const size = magnitude(shownLength(diagonal));
  const shown = digitsAfterPoint(RELATIVE_DIGITS - size) + MORE_DIGITS;
  const [whole = "", fraction = ""] = text.split(".");
  const isLong = /^\d+$/.test(fraction) && fraction.length > shown;
  return isLong ? `${whole}.${fraction.slice(0, shown - MORE_DIGITS)}…` : text;
}

/** The largest distance of an interval whose distance is not computed, as `certifiedText`. */
export const heldText = (interval: readonly [number, number], diagonal: number): string =>
  certifiedText((interval[0] + interval[1]) / 2, interval, diagonal);

/** The largest distance of an interval that ends where its limit was decided: the lower end, which a point has. */
export const attainedText = ([lower, upper]: readonly [number, number], diagonal: number): string =>
  listedText(lower, [lower, upper], diagonal);

/** A signed distance, always with its sign. */
export function signedText(distance: number, diagonal: number): string {
  const text = distanceText(Math.abs(distance), diagonal);
  return distance < 0 ? `−${text}` : `+${text}`;
}

/**
 * An interval with enough digits to distinguish its ends, but no more than
 * float64 has at the models' size. The ends are rounded outwards, so the
 * interval shown contains the certified one.
 */
export function intervalText(from: number, to: number, modelDiagonal: number): string {
  const [lower, upper] = shownInterval(from, to);
  const diagonal = shownLength(modelDiagonal);
  if (isUpperBound(lower, upper, diagonal)) return `[${short(lower, -1)}, ${short(upper, 1)}]`;
  const width = upper - lower;
  const available = SIGNIFICANT_DIGITS - 1 - magnitude(Math.max(upper, diagonal));
  const digits = digitsAfterPoint(
    width > 0 ? Math.min(2 - magnitude(width), available) : available,
  );
  const step = 10 ** -digits;
  const outwards = (end: number, sign: -1 | 1) => {
    const rounded = Number(end.toFixed(digits));
    return (sign * (rounded - end) < 0 ? rounded + sign * step : rounded).toFixed(digits);
  };
  return `[${outwards(lower, -1)}, ${outwards(upper, 1)}]`;
}

/** The decimal exponent of a positive size; 0 for size 0. */
export const magnitude = (size: number): number => (size > 0 ? Math.floor(Math.log10(size)) : 0);

const digitsAfterPoint = (digits: number): number => Math.min(MAX_DIGITS, Math.max(0, digits));

/** A number to two significant digits, such as 2.8·10⁻⁶. */
export function twoDigits(value: number): string {
  if (value === 0) return "0";
  const [digits = "", exponent = ""] = value.toExponential(1).split("e");
  if (Math.abs(Number(exponent)) < 3) return `${Number(value.toPrecision(2))}`;
  const superscript = [...`${Number(exponent)}`]
    .map((digit) => SUPERSCRIPTS[digit] ?? digit)
    .join("");
  return `${digits}·10${superscript}`;
}

const SUPERSCRIPTS: Record<string, string> = {
  "-": "⁻",
  ...Object.fromEntries([..."⁰¹²³⁴⁵⁶⁷⁸⁹"].map((superscript, digit) => [digit, superscript])),
};

/** A duration in milliseconds or seconds. */
export function duration(seconds: number): string {
  return seconds < 1
    ? texts.common.milliseconds((seconds * 1e3).toFixed(1))
    : texts.common.seconds(seconds.toFixed(2));
}

/** An integer with its digits in groups of three. */
export const grouped = (count: number): string => `${count}`.replace(/\B(?=(\d{3})+$)/g, ",");
