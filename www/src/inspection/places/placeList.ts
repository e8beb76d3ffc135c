// The list of worst places: a button each, which a key goes through.
import { element } from "../../common/elements.ts";
import { distanceText, listedText, signedText } from "../../common/text/numbers.ts";
import { exceeds } from "../../results/judgement.ts";
import type { Allowed } from "../../scene/colors/scale.ts";
import type { Place } from "./places.ts";

/** Places listed; a longer list is not read. */
const MAX_PLACES = 12;

const list = element("place-list");
const button = element("next-place", HTMLButtonElement);

export class PlaceList {
  readonly #select: (place: Place) => void;
  #places: Place[] = [];
  #selected = -1;

  /** Calls back with the place that the user selects. */
  constructor(select: (place: Place) => void) {
    this.#select = select;
    button.addEventListener("click", () => this.next());
  }

  /** The places listed. */
  get places(): readonly Place[] {
    return this.#places;
  }

  /** Shows the places, and marks those that are beyond or undecided. */
  show(places: Place[], diagonal: number, state?: (place: Place) => PlaceState): void {
    const before = this.#places[this.#selected];
    this.#places = places.slice(0, MAX_PLACES);
    // The same place, wherever it is in the list now.
    this.#selected = this.#places.findIndex(
      ({ side, face }) => side === before?.side && face === before.face,
    );
    button.disabled = places.length === 0;
    list.replaceChildren(
      ...this.#places.map((place, index) => this.#row(place, index, diagonal, state?.(place))),
    );
  }

  /** Selects the next place, after the last one the first. */
  next(): void {
    if (this.#places.length > 0) this.#choose((this.#selected + 1) % this.#places.length);
  }

  #choose(index: number): void {
    this.#selected = index;
    for (const [row, node] of [...list.querySelectorAll("button")].entries()) {
      node.setAttribute("aria-pressed", `${row === index}`);
    }
    const place = this.#places[index];
    if (place !== undefined) this.#select(place);
  }

  #row(place: Place, index: number, diagonal: number, state?: PlaceState): HTMLElement {
    const [item, row] = [document.createElement("li"), document.createElement("button")];
    row.type = "button";
    row.setAttribute("aria-pressed", `${index === this.#selected}`);
    const letter = document.createElement("b");
    letter.className = place.side;
    letter.textContent = place.side.toUpperCase();
    const [name, size] = [document.createElement("span"), document.createElement("span")];
    name.textContent = place.name;
    size.textContent = sizeText(place, diagonal);
    size.className = "size";
    if (state !== undefined) size.dataset.allowed = state;
    row.append(letter, name, size);
    row.addEventListener("click", () => this.#choose(index));
    item.append(row);
    return item;
  }
}

/** The deviation of a place, with its sign where it has one. */
export function sizeText({ distance, signed, certified }: Place, diagonal: number): string {
  const sign = signed < 0 ? "−" : "+";
  if (certified !== undefined) {
    const text = listedText(distance, [certified.lower, certified.upper], diagonal);
    return Number.isNaN(signed) || !/^[\d.]/.test(text) ? text : `${sign}${text}`;
  }
  return Number.isNaN(signed) ? distanceText(distance, diagonal) : signedText(signed, diagonal);
}

/** What is said of a face by what is allowed of it. */
export type PlaceState = "beyond" | "undecided" | "within";

/**
 * Whether a face deviates by more than is allowed: by what is certain of it, as far as that is known; a distance
 * without a sign counts as either.
 */
export function stateOf(place: Place, allowed: Allowed): PlaceState {
  const isUnsigned = Number.isNaN(place.signed);
  const { certified } = place;
  const [least, most] = [
    Math.min(allowed.above, allowed.below),
    Math.max(allowed.above, allowed.below),
  ];
  // What is certain decides, where it does: the map is an estimate.
  if (certified !== undefined) {
    if (certified.upper <= least) return "within";
    if (certified.lower > most) return "beyond";
    // Two different limits need the sign of the deviation, and the interval states none.
    if (least === most) return "undecided";
  }
  const isBeyond = (isUnsigned && place.distance > least) || exceeds(place, allowed);
  return isBeyond ? "beyond" : "within";
}
