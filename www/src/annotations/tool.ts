// The tool that puts an annotation at the next point that is clicked.
import type { Vector3 } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import { PickingTool, type Take } from "../inspection/pickingTool.ts";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";
import { mayAnnotate } from "./annotations.ts";

/** The point of a model at a position in the window. */
export interface Hit {
  side: Side;
  face: number;
  near: Vector3;
}

export interface ToolListener {
  hit: (x: number, y: number) => Hit | undefined;
  take: Take;
  begin: (hit: Hit) => void;
}

const hint = element("annotate-text");

/** Returns the tool, which ends with the first click on a model. */
export function annotationTool({ hit, take, begin }: ToolListener): PickingTool {
  const tool = new PickingTool({
    button: element("annotate", HTMLButtonElement),
    take,
    turned: (on) => {
      hint.hidden = !on;
      hint.textContent = mayAnnotate()
        ? texts.places.clickToAnnotate
        : texts.places.annotationsFull;
      // Enter is the middle of the view.
      if (on) element("canvas").focus({ preventScroll: true });
    },
    click: (x, y) => {
      const found = hit(x, y);
      // A click that hits no model annotates nothing, and so does one where there is no room.
      if (found === undefined || !mayAnnotate()) return;
      tool.end();
      begin(found);
    },
  });
  return tool;
}
