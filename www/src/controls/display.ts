// The controls of the view: what is shown of each model, directions and handles.
import { computed, effect } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import type { StandardView } from "../scene/camera/standardViews.ts";
import type { GizmoMode } from "../scene/gizmo.ts";
import type { Visibility } from "../scene/mesh.ts";
import { field, isOn, onChange } from "../state/store.ts";
import type { Side } from "../worker/protocol.ts";

const shown = { a: field("show-a"), b: field("show-b") };
const [orthographic, gizmo, fileColors] = [
  field("orthographic"),
  field("gizmo"),
  field("file-colors"),
];
const [wiped, border, beside] = [field("wipe"), field("wipe-at"), field("beside")];

/** What is shown of a model; undefined where the page decides. */
const visibilityOf = (side: Side): Visibility | undefined => {
  const { value } = shown[side];
  return value === "auto" ? undefined : (value as Visibility);
};

/** Where A is shown alone and where B is; undefined where both are. */
export interface Wiped {
  /** The border, as a part of the view's width. */
  fraction: number;
  /** Whether each is shown whole, side by side, by one camera. */
  isBeside: boolean;
}

const wipe = computed((): Wiped | undefined => {
  if (!isOn(wiped)) return undefined;
  return { fraction: isOn(beside) ? 0.5 : Number(border.value), isBeside: isOn(beside) };
});

/** How the models are shown, as far as it is chosen. */
export const display = computed(() => ({
  visibility: { a: visibilityOf("a"), b: visibilityOf("b") },
  orthographic: isOn(orthographic),
  gizmo: gizmo.value as GizmoMode,
  wipe: wipe.value,
  /** Whether models are shown in the colours of their files. */
  fileColors: isOn(fileColors),
}));

/** Offers the colours of files while a model has any. */
export function offerFileColors(offered: boolean): void {
  element("file-colors-offer").hidden = !offered;
}

/** Calls `onView` when the user selects a standard view, and `callback` on every other change. */
export function onDisplay(onView: (view: StandardView) => void, callback: () => void): void {
  const direction = element("direction", HTMLSelectElement);
  direction.addEventListener("change", () => {
    if (direction.value !== "") onView(direction.value as StandardView);
    // The list shows its title again: the user may turn the view away and select the same entry.
    direction.value = "";
  });
  effect(() => {
    element("file-colors-note").hidden = !isOn(fileColors);
    element("wipe-controls").hidden = !isOn(wiped);
    element("wipe-border").hidden = isOn(beside);
    const line = element("wipe-line");
    line.hidden = !isOn(wiped);
    line.style.left = `${100 * (wipe.value?.fraction ?? 0)}%`;
  });
  onChange(() => display.value, callback);
}
