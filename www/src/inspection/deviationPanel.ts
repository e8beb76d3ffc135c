// The deviation shown: the scale's options, the legend, statistics, and the area that is beyond
// what is allowed.
import type { DistanceResult } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import { distanceText } from "../common/numbers.ts";
import { commonUnit } from "../files/fileNotes.ts";
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
import type { MapDisplay } from "../worker/map/display.ts";
import { SIDES, type Sides } from "../worker/protocol.ts";
import { areaBeyond, totalArea } from "./cumulative.ts";
import { hideLegend, type Legend, showLegend } from "./legend.ts";

/** The deviation that the map resolves, in diagonals: its vertices are in float32. */
const POINT_ACCURACY = 5e-7;

const section = element("estimates", HTMLDetailsElement);
const map = element("scale-map", HTMLSelectElement);
const kind = element("scale-kind", HTMLSelectElement);
const range = element("scale-range", HTMLInputElement);
const steps = element("scale-steps", HTMLSelectElement);
const band = element("scale-band", HTMLInputElement);
const unfocus = element("focus-clear", HTMLButtonElement);

/** The maps shown, with the result that they are of. */
export interface ShownMaps {
  maps: Sides<MapDisplay>;
  result: DistanceResult;
  extent: Extent;
}

let shown: ShownMaps | undefined;
let focus: readonly [from: number, to: number] | undefined;
let listener: (scale: ColorScale) => void = () => {};

/** Calls back with the scale whenever the user changes it. */
export function onScale(callback: (scale: ColorScale) => void): void {
  listener = callback;
  for (const control of [map, kind, range, steps, band]) {
    control.addEventListener("input", () => setFocus(undefined));
  }
  unfocus.addEventListener("click", () => setFocus(undefined));
  element("legend-controls").addEventListener("click", () => {
    section.open = true;
    map.scrollIntoView({ block: "center" });
    map.focus();
  });
}

/** Draws with the options as they are now. */
export function rescale(): void {
  if (shown === undefined) return;
  listener(draw(shown));
}

/** Shows the maps of a result, and returns their scale and their largest distance. */
export function showMaps(
  result: DistanceResult,
  maps: Sides<MapDisplay>,
): { scale: ColorScale; largest: number } {
  const all = Object.values(maps);
  const largest = Math.max(0, ...all.map(({ largest }) => largest));
  focus = undefined;
  shown = {
    ...{ maps, result },
    extent: {
      lowest: Math.min(0, ...all.map(({ lowest }) => lowest)),
      highest: Math.max(0, ...all.map(({ highest }) => highest)),
      ...{ largest, floor: floorOf(result) },
    },
  };
  return { scale: draw(shown), largest };
}

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
  return Math.max(width, rounding, POINT_ACCURACY * result.diagonal);
}

/** Whether distances are shown: the user wants them, or a whole model has no signs. */
function isAbsolute(): boolean {
  const all = Object.values(shown?.maps ?? {});
  const isUnsigned = ({ largest, distribution }: MapDisplay) =>
    largest > 0 && totalArea(distribution.signed) === 0;
  return kind.value === "absolute" || all.some(isUnsigned);
}

function options(): ScaleOptions {
  const end = range.valueAsNumber;
  return {
    ...{ map: map.value as ScaleMap, absolute: isAbsolute(), focus },
    range: Number.isFinite(end) && end > 0 ? end : undefined,
    steps: Number(steps.value),
    allowed: band.checked ? allowed() : undefined,
  };
}

const scaleOf = ({ extent }: ShownMaps): ColorScale => new ColorScale(extent, options());

function legendOf({ maps, result, extent }: ShownMaps): Legend {
  const { absolute } = options();
  const names = SIDES.filter((side) => maps[side]).map((side) => side.toUpperCase());
  const what = absolute ? "Distance" : "Signed deviation";
  const unit = commonUnit();
  return {
    // A legend shows all colours, whichever are in focus.
    scale: new ColorScale(extent, { ...options(), focus: undefined }),
    ...{ absolute, allowed: allowed(), diagonal: result.diagonal },
    lowest: absolute ? 0 : extent.lowest,
    highest: absolute ? extent.largest : extent.highest,
    title: `${what} of ${names.join(" and ")}${unit === undefined ? "" : `, ${unit}`}`,
    distributions: Object.values(maps).map(({ distribution }) => distribution),
  };
}

function draw(now: ShownMaps): ColorScale {
  const { maps, result, extent } = now;
  const { diagonal } = result;
  showLegend(legendOf(now), (from, to) => setFocus([from, to]));
  element("beyond-limit").textContent = SIDES.flatMap((side) => {
    const text = beyond(maps[side], extent.largest, diagonal);
    return text === "" ? [] : [`${side.toUpperCase()}: ${text}`];
  })
    .concat(ownLimits().length > 0 ? ["colours and areas by the limits of the whole"] : [])
    .join("; ");
  showDetails(element("statistics"), [
    ...SIDES.flatMap((side) => {
      const { estimates, signs } = maps[side] ?? {};
      return estimates && signs ? statisticsOf(side, estimates, signs, diagonal) : [];
    }),
    ["maximum of the map", distanceText(extent.largest, diagonal)],
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
    ? `${area} of ${total}`
    : `${distanceText(area, diagonal)}${unit === undefined ? "" : ` ${unit}²`}`;
  const what = isCloud ? "points are" : "area is";
  const share = `≈ ${((100 * area) / total).toFixed(1)} % of the ${what} beyond (${size})`;
  // Less area than the map resolves is not none.
  const isBeyond = largest > Math.max(limits.above, limits.below);
  return area === 0 && isBeyond && map.largest === largest
    ? `${share}, but the farthest point is`
    : share;
}
