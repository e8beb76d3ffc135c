// Points of the models with their distances: the one under the pointer, and those pinned.

import { Vector3 } from "three";
import { element } from "../../common/elements.ts";
import { distanceText, shownLength, signedText } from "../../common/text/numbers.ts";
import { commonUnit } from "../../files/units.ts";
import type { Viewport } from "../../scene/camera/viewport.ts";
import type { Models } from "../../scene/models.ts";
import { texts } from "../../texts/index.ts";
import type { Probe } from "../../worker/protocol.ts";

const layer = element("pins");
const hover = element("hover");

/** The label's offset from its point, 12 in the style sheet, and a gap to the view's edges. */
const OFFSET = 20;

interface Pin {
  probe: Probe;
  node: HTMLElement;
}

export class Pins {
  #pins: Pin[] = [];

  /** Shows the point under the pointer at a place of the view; without one, hides that. */
  hover(probe?: Probe, diagonal = 0, at: readonly [number, number] = [0, 0]): void {
    hover.hidden = probe === undefined;
    if (probe === undefined) return;
    hover.replaceChildren(...lines(probe, diagonal));
    place(hover, at);
  }

  /** Keeps a point until its button or `clear` removes it. */
  add(probe: Probe, diagonal: number, onChange: () => void): void {
    const node = document.createElement("div");
    node.className = "pin";
    node.setAttribute("role", "note");
    const remove = document.createElement("button");
    remove.type = "button";
    remove.textContent = "×";
    remove.setAttribute("aria-label", texts.places.removeThePinnedPoint);
    remove.addEventListener("click", () => {
      this.#pins = this.#pins.filter((pin) => pin.node !== node);
      node.remove();
      onChange();
    });
    const text = document.createElement("div");
    text.append(...lines(probe, diagonal));
    node.append(text, remove);
    layer.append(node);
    this.#pins.push({ probe, node });
    onChange();
  }

  clear(): void {
    this.#pins = [];
    layer.replaceChildren();
    this.hover();
  }

  /** The points pinned. */
  get probes(): Probe[] {
    return this.#pins.map(({ probe }) => probe);
  }

  /** Moves the labels to their points on the screen. */
  update(viewport: Viewport, { center, planes, explosion }: Models): void {
    for (const { probe, node } of this.#pins) {
      const point = new Vector3(...probe.point).sub(center);
      // What a section cuts away has no pin, and points are of models as they stand.
      const cut = explosion.part > 0 || planes.some((plane) => plane.distanceToPoint(point) < 0);
      const at = cut ? undefined : viewport.project(point, probe.side);
      node.hidden = at === undefined;
      if (at !== undefined) place(node, at);
    }
  }
}

/** Places a label beside a point of the view, and shifted where it would reach over an edge. */
function place(node: HTMLElement, [x, y]: readonly [number, number]): void {
  const shift = (at: number, length: number, size: number) =>
    `${Math.min(0, size - (at + OFFSET + length))}px`;
  node.style.left = `${x}px`;
  node.style.top = `${y}px`;
  node.style.setProperty("--across", shift(x, node.offsetWidth, layer.clientWidth));
  node.style.setProperty("--down", shift(y, node.offsetHeight, layer.clientHeight));
}

function lines({ side, face, u, v, distance, signed, footFace, foot }: Probe, diagonal: number) {
  const other = side === "a" ? "B" : "A";
  const unit = commonUnit();
  const size = Number.isNaN(signed)
    ? distanceText(distance, diagonal)
    : signedText(signed, diagonal);
  const said = [
    `${size}${unit === undefined ? "" : ` ${unit}`}`,
    u === undefined || v === undefined
      ? texts.places.at(side.toUpperCase(), face)
      : texts.places.onFace(side.toUpperCase(), face, short(u), short(v)),
    texts.places.footOn(other, footFace, foot.map((at) => short(shownLength(at))).join(", ")),
  ];
  return said.map((text) => {
    const line = document.createElement("span");
    line.textContent = text;
    return line;
  });
}

/** Significant digits of coordinates and parameters. */
const DIGITS = 5;

const short = (value: number): string => `${Number(value.toPrecision(DIGITS))}`;
