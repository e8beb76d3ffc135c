// The controls of the view: what is shown of each model, directions and handles.
import { element } from "../common/elements.ts";
import type { StandardView } from "../scene/camera/standardViews.ts";
import type { GizmoMode } from "../scene/gizmo.ts";
import type { Visibility } from "../scene/mesh.ts";
import type { Side } from "../worker/protocol.ts";

const select = (id: string) => element(id, HTMLSelectElement);
const input = (id: string) => element(id, HTMLInputElement);

const shown: Record<Side, HTMLSelectElement> = { a: select("show-a"), b: select("show-b") };
const direction = select("direction");
const orthographic = input("orthographic");
const gizmo = select("gizmo");
const fileColors = input("file-colors");
const [wiped, border, beside] = [input("wipe"), input("wipe-at"), input("beside")];

/** What is shown of a model; undefined where the page decides. */
export function visibility(side: Side): Visibility | undefined {
  const { value } = shown[side];
  return value === "auto" ? undefined : (value as Visibility);
}

/** Where A is shown alone and where B is; undefined where both are. */
export interface Wiped {
  /** The border, as a part of the view's width. */
  fraction: number;
  /** Whether each is shown whole, side by side, by one camera. */
  isBeside: boolean;
}

export function wipe(): Wiped | undefined {
  if (!wiped.checked) return undefined;
  return { fraction: beside.checked ? 0.5 : border.valueAsNumber, isBeside: beside.checked };
}

/** Whether models are shown in the colours of their files. */
export const hasFileColors = (): boolean => fileColors.checked;

/** Offers the colours of files while a model has any. */
export function offerFileColors(offered: boolean): void {
  element("file-colors-offer").hidden = !offered;
}

export const isOrthographic = (): boolean => orthographic.checked;

export const gizmoMode = (): GizmoMode => gizmo.value as GizmoMode;

/** Calls `onView` when the user selects a standard view, and `onChange` on every other change. */
export function onDisplay(onView: (view: StandardView) => void, onChange: () => void): void {
  direction.addEventListener("change", () => {
    if (direction.value !== "") onView(direction.value as StandardView);
    // The list shows its title again: the user may turn the view away and select the same entry.
    direction.value = "";
  });
  const changed = () => {
    element("file-colors-note").hidden = !fileColors.checked;
    element("wipe-controls").hidden = !wiped.checked;
    const line = element("wipe-line");
    line.hidden = !wiped.checked;
    line.style.left = `${100 * (wipe()?.fraction ?? 0)}%`;
    element("wipe-border").hidden = beside.checked;
    onChange();
  };
  for (const control of [
    ...Object.values(shown),
    orthographic,
    gizmo,
    fileColors,
    wiped,
    border,
    beside,
  ]) {
    control.addEventListener("input", changed);
  }
  changed();
}
