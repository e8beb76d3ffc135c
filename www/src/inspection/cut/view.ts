// The plot of the section that the user placed, of the maps that are shown.
import { element } from "../../common/elements.ts";
import { commonUnit } from "../../files/units.ts";
import type { Models } from "../../scene/models.ts";
import { SIDES } from "../../worker/protocol.ts";
import { painted } from "../deviationPanel.ts";
import { contourOf } from "./contours.ts";
import { showCut } from "./plot.ts";

// The plot lies below what stands above the view, which takes more rows in a narrow window.
const context = element("context");
new ResizeObserver(() => {
  const end = context.offsetTop + context.offsetHeight;
  element("cut").style.setProperty("--tools-end", `${end}px`);
}).observe(context, { box: "border-box" });

/** Draws the deviation along the section; without a section or a map, nothing. */
export function drawCut(models: Models): void {
  const { cut } = models;
  const shown = painted();
  // Bodies that are moved apart have no deviations there.
  if (cut === undefined || shown === undefined || models.explosion.part > 0) {
    showCut(undefined);
    return;
  }
  const { drawn, scale, extent } = shown;
  const pieces = SIDES.flatMap((side) => {
    const map = drawn[side];
    return map === undefined ? [] : contourOf(map, models.matrixOf(side), cut, side);
  });
  showCut({
    ...{ cut, maps: drawn, pieces, scale, largest: extent.largest },
    ...{ center: models.center, unit: commonUnit() },
  });
}
