// The legend: the scale upright, with ticks at its ends, at zero, at what is allowed and at the
// extremes found, and the histogram beside it.
import { element } from "../common/elements.ts";
import { distanceText, signedText } from "../common/text/numbers.ts";
import type { Allowed, ColorScale, Mark } from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { Distribution } from "../worker/map/distribution.ts";
import { BINS, binsOf, histogram } from "./histogram.ts";

/** The stops of the scale's gradient. */
const STOPS = 96;
/** The least distance of two labels as a fraction of the scale: a line of text in its 300 px. */
const MIN_GAP = 0.05;

/** What the legend shows. */
export interface Legend {
  scale: ColorScale;
  absolute: boolean;
  allowed: Allowed | undefined;
  diagonal: number;
  title: string;
  distributions: readonly Distribution[];
}

/** A labelled place of the scale. */
export interface Tick extends Mark {
  text: string;
}

const legend = element("legend");

/** Shows the legend; calls back with the ends of a bin of the histogram that is pressed. */
export function showLegend(shown: Legend, onBin: (from: number, to: number) => void): void {
  const { scale, absolute, distributions, title } = shown;
  legend.hidden = false;
  element("legend-title").textContent = title;
  element("scale").style.setProperty("--stops", stopsOf(scale));
  element("scale-labels").replaceChildren(...ticksOf(shown).map((tick) => label(tick, scale)));
  const bins = binsOf(distributions, scale, absolute);
  const at = (edge: number) => scale.low + (edge / BINS) * (scale.high - scale.low);
  const pressed = (bin: number) =>
    onBin(
      bin === 0 ? Number.NEGATIVE_INFINITY : at(bin),
      bin === BINS - 1 ? Number.POSITIVE_INFINITY : at(bin + 1),
    );
  element("histogram").replaceChildren(histogram(bins, scale, pressed));
}

export function hideLegend(): void {
  legend.hidden = true;
}

/** The colours of a scale as the stops of a gradient, which the style sheet turns. */
function stopsOf(scale: ColorScale): string {
  const stops = scale.stops(STOPS).map((color, index) => {
    const [from, to] = [index, index + 1].map((edge) => `${(100 * edge) / STOPS}%`);
    return `${color.getStyle()} ${from} ${to}`;
  });
  return stops.join(", ");
}

/** Returns the ticks with their texts, the important ones first, without those that would cover each other. */
export function ticksOf({ scale, absolute, allowed, diagonal }: Legend): Tick[] {
  const named: Record<Mark["kind"], (shown: string) => string> = {
    end: (shown) => shown,
    zero: (shown) => shown,
    allowed: texts.places.allowedAt,
    least: texts.places.leastAt,
    most: texts.places.mostAt,
  };
  return scale.marks(MIN_GAP, allowed).map(({ value, kind }) => {
    const isPlain = value === 0 || absolute;
    const text = isPlain ? distanceText(value, diagonal) : signedText(value, diagonal);
    return { value, kind, text: named[kind](text) };
  });
}

function label({ value, text, kind }: Tick, scale: ColorScale): HTMLElement {
  const node = document.createElement("span");
  node.textContent = text;
  node.dataset.kind = kind;
  if (value === scale.high) node.id = "scale-high";
  else if (value === scale.low) node.id = "scale-low";
  node.style.setProperty("--at", `${(100 * (value - scale.low)) / (scale.high - scale.low)}%`);
  return node;
}
