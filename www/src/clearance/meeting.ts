// How near the models come, in the view: the faces of the gaps, and the place of a clash.

import { placeName } from "../common/text/names.ts";
import { certifiedText } from "../common/text/numbers.ts";
import type { FaceClass } from "../scene/faces.ts";
import type { View } from "../scene/view.ts";
import { texts } from "../texts/index.ts";
import type { Side, Sides } from "../worker/protocol.ts";
import type { ShownClearance } from "./clearancePanel.ts";

/** Shows a clearance; without one, the deviations again. */
export function showMeeting(view: View, shown: ShownClearance | undefined): void {
  if (shown === undefined) {
    view.classify({});
    view.point();
    return;
  }
  const { clearance, gaps, meeting } = shown;
  // Faces that are not near have the colours of their models, which are seen through.
  const own = (side: Side): FaceClass[] =>
    Array(view.models.drawn[side]?.faceCount ?? 0).fill("own");
  const classes: Required<Sides<FaceClass[]>> = { a: own("a"), b: own("b") };
  for (const { lower, upper, witness } of gaps?.pairs ?? []) {
    const met = meeting !== "apart" && lower === 0 && upper <= clearance.tolerance;
    for (const side of ["a", "b"] as const) {
      const { face } = witness[side];
      if (classes[side][face] !== "clash") classes[side][face] = met ? "clash" : "near";
    }
  }
  view.classify(classes);
  // A that was moved is not lost.
  view.keepInView();
  const { overlap, witness, diagonal, lower, upper } = clearance;
  if (overlap !== undefined && "insideBoth" in overlap) {
    const { insideBoth } = overlap;
    view.point({
      from: insideBoth,
      to: insideBoth,
      texts: { length: texts.bodies.states.clash, from: "", to: "" },
    });
    return;
  }
  const { a, b } = witness;
  const ends = {
    length:
      meeting === "touching"
        ? texts.bodies.states.touching
        : certifiedText(upper, [lower, upper], diagonal),
    from: `A: ${placeName(a)}`,
    to: `B: ${placeName(b)}`,
  };
  view.point({ from: a.point, to: b.point, texts: ends });
}
