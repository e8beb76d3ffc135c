// The controls of the section: along an axis or by any normal, its offset and tilt.

import { batch, computed, effect } from "@preact/signals-core";
import { Vector3 } from "three";
import { element } from "../common/elements.ts";
import { PickingTool, type Take } from "../inspection/pickingTool.ts";
import type { Models } from "../scene/models.ts";
import { extentOf, type Section } from "../scene/section.ts";
import { type Field, field, isOn, onChange } from "../state/store.ts";
import { texts } from "../texts/index.ts";

const [axis, position] = [field("section"), field("section-at")];
const [flipped, free] = [field("section-flip"), field("section-free")];
const tilts = [field("section-tilt"), field("section-turn")] as const;
/** The place of the plane, which is that of the slider in other words. */
const offset = element("section-offset", HTMLInputElement);

/** The value of the list for a section by any normal. */
const FREE = "free";
/** Significant digits of a free section in the address, and of its offset. */
const DIGITS = 9;
const TEXT_DIGITS = 6;
/** The least step of the offset that is shown, in lengths of its way. */
const OFFSET_STEP = 1e-6;
/** How far beneath a face a section along it is, in lengths of its way: they would fight for depth. */
const BENEATH = 2e-3;
/** The most digits behind the point that JavaScript writes. */
const MAX_DIGITS = 100;
/** The largest tilt, in degrees. */
const MAX_TILT = 89;

/** A plane by a point and its normal. */
export interface Facing {
  point: Vector3;
  normal: Vector3;
}

export interface SectionListener {
  models: Models;
  /** What the view looks at, and the direction from there to the eye. */
  seen: () => Facing | undefined;
  /** The place of a model at a position in the window, and its normal. */
  facing: (x: number, y: number) => Facing | undefined;
  take: Take;
}

/** The section plane; undefined without one. */
export const section = computed((): Section | undefined => {
  const common = {
    fraction: Number(position.value),
    tilt: [tiltOf(tilts[0]), tiltOf(tilts[1])] as const,
    flipped: isOn(flipped),
  };
  if (axis.value === "") return undefined;
  if (axis.value !== FREE) {
    const along = Number(axis.value) as 0 | 1 | 2;
    const normal = new Vector3().setComponent(along, 1);
    return { ...common, axis: along, normal, through: undefined };
  }
  const facing = freeFacing();
  if (facing === undefined) return undefined;
  return { ...common, axis: undefined, normal: facing.normal, through: facing.point };
});

/** Calls back on every change of the section. */
export function onSection(listener: SectionListener, callback: () => void): void {
  // One that is chosen anew is straight; a state sets its tilts after its axis.
  element("section-axis").addEventListener("input", () =>
    batch(() => {
      for (const tilt of tilts) tilt.set("0");
      showCutFace(listener.seen());
      if (axis.value === FREE && freeFacing() === undefined) setFree(listener, listener.seen());
    }),
  );
  offset.addEventListener("change", () => {
    const [low, high] = rangeOf(listener.models) ?? [0, 1];
    const fraction = (offset.valueAsNumber - low) / (high - low || 1);
    if (Number.isFinite(fraction)) position.set(within(fraction));
    showOffset(listener.models);
  });
  element("section-view").addEventListener("click", () => setFree(listener, listener.seen()));
  const byClick = new PickingTool({
    button: element("section-face", HTMLButtonElement),
    take: listener.take,
    click: (x, y) => {
      const facing = listener.facing(x, y);
      // A click beside the models picks no face: the next one may.
      if (facing === undefined) return;
      byClick.end();
      setFree(listener, facing, BENEATH);
    },
  });
  effect(() => {
    element("section-controls").hidden = axis.value === "";
  });
  onChange(() => section.value, callback);
}

/** A part of the section's way, as the slider has it. */
const within = (fraction: number): string => `${Math.max(0, Math.min(1, fraction))}`;

/** Shows where the section is, in model units: along its axis, or from the point that it goes through. */
export function showOffset(models: Models): void {
  const range = rangeOf(models);
  if (range === undefined) return;
  const length = range[1] - range[0];
  const at = range[0] + Number(position.value) * length;
  const digits = Math.max(0, Math.ceil(-Math.log10(OFFSET_STEP * length)));
  offset.value = `${Number(at.toFixed(Math.min(digits, MAX_DIGITS)))}`;
}

/** What a report says of the section; nothing without one. */
export function sectionText({ cut, center }: Models): string | undefined {
  const own = section.value;
  if (cut === undefined || own === undefined) return undefined;
  const number = (value: number) => `${Number(value.toPrecision(TEXT_DIGITS))}`;
  const list = (vector: Vector3) => `(${vector.toArray().map(number).join(", ")})`;
  const point = cut.plane.coplanarPoint(new Vector3());
  if (cut.isStraight && own.axis !== undefined) {
    const at = point.getComponent(own.axis) + center.getComponent(own.axis);
    return texts.files.sectionAt(["x", "y", "z"][own.axis], number(at));
  }
  return texts.files.sectionByTheNormalThrough(list(cut.plane.normal), list(point.add(center)));
}

/** The ends of the section's way, in what the field of its offset shows. */
function rangeOf({ box, center }: Models): [number, number] | undefined {
  const own = section.value;
  if (own === undefined || box.isEmpty()) return undefined;
  const [low, high] = extentOf(box, own.normal);
  const { axis: along, normal, through } = own;
  const zero =
    along === undefined ? -normal.dot(through ?? new Vector3()) : center.getComponent(along);
  return [low + zero, high + zero];
}

/** Keeps the side of a section along an axis whose cut the user sees; a state says which side after its axis. */
function showCutFace(seen: Facing | undefined): void {
  const along = Number(axis.value);
  if (axis.value === "" || !Number.isInteger(along) || seen === undefined) return;
  flipped.set(seen.normal.getComponent(along) < 0 ? "on" : "");
}

/** Cuts by a plane of any normal, as far beneath a point as is said. */
function setFree({ models }: SectionListener, facing: Facing | undefined, beneath = 0): void {
  if (facing === undefined) {
    // No face or view gives a plane: without a normal from before, the section ends.
    if (axis.value === FREE && freeFacing() === undefined) axis.set("");
    return;
  }
  const { point, normal } = facing;
  const values = [...normal.toArray(), ...point.toArray()];
  const [low, high] = extentOf(models.box, normal);
  const fraction = (normal.dot(point) - low) / (high - low || 1) - beneath;
  batch(() => {
    free.set(values.map((value) => `${Number(value.toPrecision(DIGITS))}`).join(","));
    axis.set(FREE);
    for (const tilt of tilts) tilt.set("0");
    position.set(within(fraction));
    flipped.set("");
  });
}

/** The normal and the point of a free section; undefined for a text of an address that states none. */
function freeFacing(): Facing | undefined {
  const [x = 0, y = 0, z = 0, ...point] = free.value.split(",").map(Number);
  const normal = new Vector3(x, y, z);
  const isStated = point.length === 3 && [x, y, z, ...point].every(Number.isFinite);
  if (!isStated || !(normal.lengthSq() > 0)) return undefined;
  return { normal: normal.normalize(), point: new Vector3().fromArray(point) };
}

/** A tilt in degrees; 0 for a field without a number. */
function tiltOf({ value }: Pick<Field, "value">): number {
  const degrees = Number(value);
  return Number.isFinite(degrees) ? Math.max(-MAX_TILT, Math.min(MAX_TILT, degrees)) : 0;
}
