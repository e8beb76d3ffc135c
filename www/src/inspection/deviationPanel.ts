// The panel of the deviation: the colour scale's options, the legend, the histogram,
// statistics, and the area beyond the limit.
import type { DistanceResult } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/numbers.ts";
import { commonUnit } from "../files/fileNotes.ts";
import { statisticsOf } from "../results/resultDetails.ts";
import { showDetails } from "../results/resultPanel.ts";
import { limit } from "../results/verdict.ts";
import { ColorScale, type Extent, type ScaleOptions } from "../scene/colors/scale.ts";
import type { FieldDisplay } from "../worker/field/fieldDisplay.ts";
import { areaBeyond, totalArea } from "./cumulative.ts";
import { histogram } from "./histogram.ts";

/** The stops of the legend's gradient. */
const STOPS = 64;

const legend = element("legend");
const section = element("estimates");
const kind = element("scale-kind", HTMLSelectElement);
const range = element("scale-range", HTMLInputElement);
const steps = element("scale-steps", HTMLSelectElement);
const band = element("scale-band", HTMLInputElement);

interface Shown {
  field: FieldDisplay;
  result: DistanceResult;
  extent: Extent;
}

let shown: Shown | undefined;
let listener: (scale: ColorScale) => void = () => {};

/** Calls back with the scale whenever the user changes it. */
export function onScale(callback: (scale: ColorScale) => void): void {
  listener = callback;
  for (const control of [kind, range, steps, band]) control.addEventListener("input", rescale);
}

/** Draws with the options as they are now. */
export function rescale(): void {
  if (shown === undefined) return;
  listener(draw(shown));
}

/** Shows the deviation of a result, and returns its scale and its largest distance. */
export function showDeviation(
  result: DistanceResult,
  field: FieldDisplay,
): { scale: ColorScale; largest: number } {
  const directed = result.forward ?? result;
  const { absolute, signed } = field.distribution;
  const largest = absolute.values.at(-1) ?? 0;
  shown = {
    field,
    result,
    extent: {
      lowest: signed.values[0] ?? 0,
      highest: signed.values.at(-1) ?? 0,
      largest,
      floor: floorOf(directed),
    },
  };
  return { scale: draw(shown), largest };
}

export function hideDeviation(): void {
  shown = undefined;
  legend.hidden = true;
  section.hidden = true;
}

/** The deviation shown, with its colours. */
export function painted(): { field: FieldDisplay; scale: ColorScale } | undefined {
  return shown && { field: shown.field, scale: new ColorScale(shown.extent, options()) };
}

/** What the report contains of the deviation. */
export function deviationSummary(): HTMLElement | undefined {
  return shown === undefined ? undefined : element("deviation-summary");
}

/** The deviation that cannot be distinguished from 0: the interval's width, and rounding. */
function floorOf(result: DistanceResult): number {
  const rounding = result.method === "certified" ? result.minTolerance : 0;
  return Math.max(result.upper - result.lower, rounding);
}

function options(): ScaleOptions {
  const end = range.valueAsNumber;
  return {
    absolute: kind.value === "absolute",
    range: Number.isFinite(end) && end > 0 ? end : undefined,
    steps: Number(steps.value),
    limit: band.checked ? limit() : undefined,
  };
}

function draw({ field, result, extent }: Shown): ColorScale {
  const chosen = options();
  const scale = new ColorScale(extent, chosen);
  const { diagonal } = result;
  const stops = scale.stops(STOPS).map((color, index) => {
    const [from, to] = [index, index + 1].map((edge) => `${(100 * edge) / STOPS}%`);
    return `${color.getStyle()} ${from} ${to}`;
  });
  element("scale").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
  const endText = (value: number) =>
    value === 0 || chosen.absolute ? distanceText(value, diagonal) : signedText(value, diagonal);
  element("scale-low").textContent = endText(scale.low);
  element("scale-middle").textContent = endText((scale.low + scale.high) / 2);
  element("scale-high").textContent = endText(scale.high);
  element("legend-title").textContent = chosen.absolute
    ? "Distance of A from B"
    : "Signed deviation of A (+ along B’s normals)";
  element("histogram").replaceChildren(histogram(field.distribution, scale, chosen.absolute));
  element("beyond-limit").textContent = beyondLimit(field, extent.largest, diagonal);
  showDetails(element("statistics"), [
    ...statisticsOf(result),
    ["maximum of the samples", `≈ ${distanceText(extent.largest, diagonal)}`],
  ]);
  legend.hidden = false;
  section.hidden = false;
  range.placeholder = `${Number(extent.largest.toPrecision(3))}`;
  return scale;
}

function beyondLimit({ distribution }: FieldDisplay, largest: number, diagonal: number): string {
  const allowed = limit();
  const total = totalArea(distribution.absolute);
  if (allowed === undefined || total === 0) return "";
  const area = areaBeyond(distribution, allowed);
  const unit = commonUnit();
  const size = `${distanceText(area, diagonal)}${unit === undefined ? "" : ` ${unit}²`}`;
  const share = `Beyond the limit: ≈ ${((100 * area) / total).toFixed(1)} % of A’s area (${size})`;
  // Less area than the samples resolve is not none.
  return area === 0 && largest > allowed ? `${share}, but the farthest point is beyond` : share;
}
