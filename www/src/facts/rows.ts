// The rows of the table of facts: what is certain of A, of B, and of how B differs from A.

import type { Body, Facts, Interval, VolumeUnknown } from "nurbs-hausdorff";
import { minus, percentText, shownQuantity, times } from "../common/text/quantities.ts";
import { texts } from "../texts/index.ts";
import { SIDES, type Side, type Sides } from "../worker/protocol.ts";
import type { Subject } from "./pairs.ts";

/** A fact as an interval in the unit shown, or why there is none. */
export type Fact = Interval | string;

export interface FactRow {
  name: string;
  facts: Sides<Fact>;
  /** B less A, where both have it. */
  difference?: Interval;
  /** The difference in percent of A, of what has a size. */
  percent?: string;
}

/** The units of what is shown. */
export interface FactUnits {
  /** The name of the unit of lengths; undefined where that of a model is unknown. */
  name: string | undefined;
  /** A's units in one of B's. */
  scale: number;
  /** Metres in one of A's units. */
  metres: number;
  /** In g/cm³. */
  density: number | undefined;
}

/** Grams in a cubic metre at 1 g/cm³, and in a kilogram. */
const GRAMS = 1e6;
const KILO = 1000;
/** The relative rounding of the cube of a unit of length, with a margin. */
const CUBE_ROUNDING = 2 ** -49;
/** Why there is no volume. */
const NO_VOLUME: Record<VolumeUnknown, string> = {
  open: texts.bodies.notClosed,
  notOrientable: texts.bodies.noInside,
  nesting: texts.bodies.notDecided,
  points: texts.bodies.points,
};
const AXES = ["x", "y", "z"] as const;

/** What lengths, areas and volumes are in. */
export const unitsText = ({ name }: FactUnits): string =>
  name === undefined ? texts.bodies.modelUnits : `${name}, ${name}², ${name}³`;

/** The same in a sentence. */
export const unitsSentence = (units: FactUnits): string =>
  texts.bodies.lengthsAreasAndVolumes(unitsText(units));

/** Returns the rows of models or bodies. */
export function factRows({ facts, bodies }: Subject, units: FactUnits): FactRow[] {
  const row = (
    title: string,
    power: number,
    of: (facts: Facts) => Fact | null,
    isSize?: boolean,
  ): FactRow =>
    withDifference(
      title,
      each(facts, (own, side) => {
        const fact = of(own) ?? "–";
        const scale = side === "b" ? units.scale : 1;
        return typeof fact === "string" ? fact : shownQuantity(fact, power, scale);
      }),
      isSize,
    );
  return [
    row(texts.bodies.volumeRow, 3, volumeOf),
    ...massRow(facts, units),
    row(texts.bodies.area, 2, ({ area }) => area),
    ...AXES.map((axis, at) =>
      row(texts.bodies.extent(axis), 1, ({ extents }) => extents[at] ?? null),
    ),
    ...AXES.map((axis, at) =>
      row(texts.bodies.centroid(axis), 1, ({ centroid }) => centroid?.[at] ?? null, false),
    ),
    { name: texts.bodies.bodies, facts: each(bodies, bodiesText) },
  ];
}

const volumeOf = ({ volume, volumeUnknown }: Facts): Fact =>
  volume ?? (volumeUnknown === undefined ? "–" : NO_VOLUME[volumeUnknown]);

/** The mass by the density that was typed; none without one. */
function massRow(facts: Subject["facts"], units: FactUnits): FactRow[] {
  const { density, metres, scale, name } = units;
  if (density === undefined) return [];
  if (name === undefined) {
    return [{ name: texts.bodies.mass, facts: each(facts, () => texts.bodies.unitUnknown) }];
  }
  const grams = each(facts, (own, side) => {
    const volume = volumeOf(own);
    if (typeof volume === "string") return volume;
    const length = metres * (side === "b" ? scale : 1);
    return times(volume, length ** 3 * GRAMS * density, CUBE_ROUNDING);
  });
  const isHeavy = Object.values(grams).some((one) => typeof one === "object" && one.upper >= KILO);
  const shown = each(grams, (one) =>
    typeof one === "string" || !isHeavy ? one : times(one, 1 / KILO, CUBE_ROUNDING),
  );
  return [withDifference(isHeavy ? texts.bodies.massKg : texts.bodies.massG, shown)];
}

/** How many bodies there are, and how many of them have no volume. */
function bodiesText(bodies: readonly Body[]): string {
  const [only] = bodies;
  if (bodies.length === 1 && only) {
    if (only.kind === "points") return texts.bodies.points;
    const holes = only.voids > 0 ? `, ${texts.bodies.voids(only.voids)}` : "";
    return `${only.kind === "solid" ? texts.bodies.solids(1) : texts.bodies.sheets(1)}${holes}`;
  }
  const sheets = bodies.filter(({ kind }) => kind === "sheet").length;
  const solids = bodies.filter(({ kind }) => kind === "solid").length;
  return [
    ...(solids > 0 ? [texts.bodies.solids(solids)] : []),
    ...(sheets > 0 ? [texts.bodies.sheets(sheets)] : []),
  ].join(", ");
}

function each<Of, To>(of: Sides<Of>, to: (one: Of, side: Side) => To): Sides<To> {
  const all: Sides<To> = {};
  for (const side of SIDES) {
    const one = of[side];
    if (one !== undefined) all[side] = to(one, side);
  }
  return all;
}

/** A row with the difference where it is known, in percent too of what has a size and is no place. */
function withDifference(name: string, facts: Sides<Fact>, isSize = true): FactRow {
  const { a, b } = facts;
  if (typeof a !== "object" || typeof b !== "object") return { name, facts };
  const difference = minus(b, a);
  return { name, facts, difference, percent: isSize ? percentText(difference, a) : "" };
}
