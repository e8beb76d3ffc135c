// The deviation shown: the scale's options, the legend, statistics, and the area that is beyond
// what is allowed.

import type { DiffResult, DistanceResult } from "nurbs-hausdorff";
import { AGREEING } from "../common/direction.ts";
import { element } from "../common/elements.ts";
import { distanceText, shownLength } from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import { ownLimits } from "../results/ownLimits.ts";
import { statisticsOf } from "../results/resultDetails.ts";
import { showDetails } from "../results/resultPanel.ts";
import { allowed } from "../results/verdict.ts";
import {
  ColorScale,
  type Extent,
  type ScaleMap,
  type ScaleOptions,
} from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { MapDisplay } from "../worker/map/display.ts";
import { SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { areaBeyond, totalArea } from "./cumulative.ts";
import { showDistribution } from "./distributionPlot.ts";
import { hideLegend, type Legend, showLegend } from "./legend.ts";

const section = element("estimates");
const map = element("scale-map", HTMLSelectElement);
const kind = element("scale-kind", HTMLSelectElement);
const range = element("scale-range", HTMLInputElement);
const rangeBelow = element("scale-range-below", HTMLInputElement);
const steps = element("scale-steps", HTMLSelectElement);
const band = element("scale-band", HTMLInputElement);
const unfocus = element("focus-clear", HTMLButtonElement);

/** The maps of a result. */
export interface ShownMaps {
  /** Those of both models, where both were asked for. */
  maps: Sides<MapDisplay>;
  /** Those that are drawn in their colours. */
  drawn: Sides<MapDisplay>;
  result: DistanceResult;
  extent: Extent;
  /** What is certain of each face, once it is known. */
  bounds?: DiffResult;
}

let shown: ShownMaps | undefined;
let focus: readonly [from: number, to: number] | undefined;
let listener: (painting: Painting) => void = () => {};

/** Maps to draw, in the colours of a scale. */
export interface Painting {
  scale: ColorScale;
  maps: Sides<MapDisplay>;
  /** Whether only the scale is another one than before. */
  isSame: boolean;
}

/** Calls back with what to draw whenever the user changes it. */
export function onScale(callback: (painting: Painting) => void): void {
  listener = callback;
  kind.addEventListener("input", () => {
    if (shown !== undefined) shown = { ...shown, ...shownOf(shown.result, shown.maps) };
    focus = undefined;
    unfocus.hidden = true;
    repaint();
  });
  for (const control of [map, range, rangeBelow, steps, band]) {
    control.addEventListener("input", () => setFocus(undefined));
  }
  unfocus.addEventListener("click", () => setFocus(undefined));
}

/** Draws with the options as they are now. */
export function rescale(): void {
  if (shown === undefined) return;
  listener({ ...paintingOf(shown), isSame: true });
}

/** Draws the maps anew, because their deviations or what is drawn of them changed. */
function repaint(): void {
  if (shown !== undefined) listener({ ...paintingOf(shown), isSame: false });
}

/** Shows the maps of a result, and returns what to draw. */
export function showMaps(result: DistanceResult, maps: Sides<MapDisplay>): Painting {
  focus = undefined;
  shown = shownOf(result, maps);
  return { ...paintingOf(shown), isSame: false };
}

/** Shows what is certain of each face, and maps in place of those that were more than that. */
export function bound(bounds: DiffResult, kept: Sides<MapDisplay>): void {
  if (shown === undefined) return;
  shown = { ...shownOf(shown.result, { ...shown.maps, ...kept }), bounds };
  if (Object.keys(kept).length > 0) repaint();
}

/** The models that are painted. */
export const paintedSides = (): readonly Side[] | undefined =>
  shown && SIDES.filter((side) => shown?.drawn[side] !== undefined);

function shownOf(result: DistanceResult, maps: Sides<MapDisplay>): ShownMaps {
  const drawn = drawnOf(maps);
  const all = Object.values(drawn);
  const largest = Math.max(0, ...all.map(({ largest }) => largest));
  const extent = {
    lowest: Math.min(0, ...all.map(({ lowest }) => lowest)),
    highest: Math.max(0, ...all.map(({ highest }) => highest)),
    ...{ largest, floor: floorOf(result) },
  };
  return { maps, drawn, result, extent };
}

/** The maps with signs where one has them and the other has none: a common scale would lose them. */
function drawnOf(maps: Sides<MapDisplay>): Sides<MapDisplay> {
  if (kind.value === "absolute") return maps;
  const signed = SIDES.flatMap((side) => {
    const map = maps[side];
    return map === undefined || isUnsigned(map) ? [] : [[side, map] as const];
  });
  return signed.length === 0 ? maps : Object.fromEntries(signed);
}

const paintingOf = (now: ShownMaps): Omit<Painting, "isSame"> => ({
  ...{ scale: draw(now), maps: now.drawn },
});

/** Whether no deviation of a map has a sign. */
const isUnsigned = ({ largest, distribution }: MapDisplay): boolean =>
  largest > 0 && totalArea(distribution.signed) === 0;

export function hideMaps(): void {
  shown = undefined;
  hideLegend();
  section.hidden = true;
}

/** The maps shown, with their colours. */
export const painted = (): (ShownMaps & { scale: ColorScale; legend: Legend }) | undefined =>
  shown && { ...shown, scale: scaleOf(shown), legend: legendOf(shown) };

function setFocus(range: typeof focus): void {
  focus = range;
  unfocus.hidden = range === undefined;
  rescale();
}

/** The deviation that cannot be distinguished from 0: the interval's width, and rounding. */
function floorOf(result: DistanceResult): number {
  const rounding = result.method === "certified" ? result.minTolerance : 0;
  const width = result.forward === undefined ? result.upper - result.lower : 0;
  return Math.max(width, rounding, AGREEING * result.diagonal);
}

/** Whether distances are shown: the user wants them, or what is drawn has no signs. */
const isAbsolute = (): boolean =>
  kind.value === "absolute" || Object.values(shown?.drawn ?? {}).some(isUnsigned);

function options(): ScaleOptions {
  return {
    ...{ map: map.value as ScaleMap, absolute: isAbsolute(), focus },
    range: endOf(range),
    rangeBelow: endOf(rangeBelow),
    steps: Number(steps.value),
    allowed: band.checked ? allowed() : undefined,
  };
}

/** The end of the scale that is typed. */
function endOf({ valueAsNumber: end }: HTMLInputElement): number | undefined {
  return Number.isFinite(end) && end > 0 ? end : undefined;
}

const scaleOf = ({ extent }: ShownMaps): ColorScale => new ColorScale(extent, options());

function legendOf({ maps, drawn, result, extent }: ShownMaps): Legend {
  const { absolute } = options();
  const namesOf = (which: Sides<MapDisplay>) =>
    SIDES.filter((side) => which[side]).map((side) => side.toUpperCase());
  const names = namesOf(drawn);
  const without = namesOf(maps).filter((name) => !names.includes(name));
  const what = absolute ? texts.places.distance : texts.places.signedDeviation;
  const unit = commonUnit();
  return {
    // A legend shows all colours, whichever are in focus.
    scale: new ColorScale(extent, { ...options(), focus: undefined }),
    ...{ absolute, allowed: allowed(), diagonal: result.diagonal },
    title: texts.places.deviationOf(
      what,
      names.join(texts.places.and),
      unit === undefined ? "" : `, ${unit}`,
      without.map(texts.places.hasNoSign).join(""),
    ),
    distributions: Object.values(drawn).map(({ distribution }) => distribution),
  };
}

function draw(now: ShownMaps): ColorScale {
  const { maps, result, extent } = now;
  const { diagonal } = result;
  const legend = legendOf(now);
  showLegend(legend, (from, to) => setFocus([from, to]));
  showDistribution(legend);
  element("beyond-limit").textContent = SIDES.flatMap((side) => {
    const text = beyond(maps[side], extent.largest, diagonal);
    return text === "" ? [] : [`${side.toUpperCase()}: ${text}`];
  })
    .concat(ownLimits().length > 0 ? [texts.places.coloursAndAreasByThe] : [])
    .join("; ");
  showDetails(element("statistics"), [
    ...SIDES.flatMap((side) => {
      const map = maps[side];
      if (map?.estimates === undefined) return [];
      const signs = isUnsigned(map) ? undefined : map.signs;
      return statisticsOf(side, map.estimates, signs, diagonal);
    }),
    [texts.places.maximumOfTheMap, distanceText(extent.largest, diagonal)],
  ]);
  section.hidden = false;
  range.placeholder = `${Number(extent.largest.toPrecision(3))}`;
  return scaleOf(now);
}

function beyond(map: MapDisplay | undefined, largest: number, diagonal: number): string {
  const limits = allowed();
  const total = map === undefined ? 0 : totalArea(map.distribution.absolute);
  if (map === undefined || limits === undefined || total === 0) return "";
  const area = areaBeyond(map.distribution, limits);
  const unit = commonUnit();
  const isCloud = map.indices.length === 0;
  const size = isCloud
    ? texts.places.ofTotal(area, total)
    : `${distanceText(shownLength(area), diagonal)}${unit === undefined ? "" : ` ${unit}²`}`;
  const what = isCloud ? texts.places.pointsAre : texts.places.areaIs;
  const out = ((100 * area) / total).toFixed(1);
  const within = (100 - Number(out)).toFixed(1);
  const share = texts.places.beyondAndWithin(out, what, size, within);
  // Less area than the map resolves is not none.
  const isBeyond = largest > Math.max(limits.above, limits.below);
  return area === 0 && isBeyond && map.largest === largest
    ? texts.places.butTheFarthestPoint(share)
    : share;
}
