// How near the models come, in the view: the faces of the gaps, and the place of a clash.

import { certifiedText } from "../common/numbers.ts";
import type { FaceClass } from "../scene/faces.ts";
import type { View } from "../scene/view.ts";
import type { Sides } from "../worker/protocol.ts";
import { nameOf, type ShownClearance } from "./clearancePanel.ts";

/** Shows a clearance; without one, the deviations again. */
export function showMeeting(view: View, shown: ShownClearance | undefined): void {
  if (shown === undefined) {
    view.classify({});
    view.point();
    return;
  }
  const { clearance, gaps, meeting } = shown;
  const classes: Required<Sides<FaceClass[]>> = { a: [], b: [] };
  for (const { lower, upper, witness } of gaps?.pairs ?? []) {
    const met = meeting !== "apart" && lower === 0 && upper <= clearance.tolerance;
    for (const side of ["a", "b"] as const) {
      const { face } = witness[side];
      if (classes[side][face] !== "clash") classes[side][face] = met ? "clash" : "near";
    }
  }
  view.classify(classes);
  const { overlap, witness, diagonal, lower, upper } = clearance;
  if (overlap !== undefined && "insideBoth" in overlap) {
    const { insideBoth } = overlap;
    view.point({ from: insideBoth, to: insideBoth, texts: { length: "clash", from: "", to: "" } });
    return;
  }
  const { a, b } = witness;
  const texts = {
    length: meeting === "touching" ? "touching" : certifiedText(upper, [lower, upper], diagonal),
    from: `A: ${nameOf(a)}`,
    to: `B: ${nameOf(b)}`,
  };
  view.point({ from: a.point, to: b.point, texts });
}
