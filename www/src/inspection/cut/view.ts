// The plot of the section that the user placed, of the maps that are shown.
import { element } from "../../common/elements.ts";
import { commonUnit } from "../../files/units.ts";
import type { Models } from "../../scene/models.ts";
import { painted } from "../deviationPanel.ts";
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
  const { drawn: maps, scale, extent } = shown;
  showCut({
    ...{ maps, scale, cut, largest: extent.largest },
    ...{ center: models.center, unit: commonUnit() },
    place: (side, vertex) => {
      const [x = 0, y = 0, z = 0] =
        maps[side]?.positions.subarray(3 * vertex, 3 * vertex + 3) ?? [];
      return models.place(side, [x, y, z]);
    },
  });
}
