// The pointer on the view: resting shows a point's distance, clicking pins it.

/** Milliseconds after which a pointer that does not move rests. */
const REST = 120;
/** Pixels that a pointer may move during a click. */
const CLICK_TOLERANCE = 4;

/** Receives a position in the window, and whether to pin the point there. */
export type OnPoint = (clientX: number, clientY: number, pin: boolean) => void;

/**
 * Calls back when the pointer rests or clicks, and `onLeave` when it moves on; the keyboard clicks at `middle`, the
 * middle of what is seen.
 */
export function onPointer(
  canvas: HTMLCanvasElement,
  onPoint: OnPoint,
  onLeave: () => void,
  middle: () => readonly [clientX: number, clientY: number] | undefined,
): void {
  let timer = 0;
  let down: PointerEvent | undefined;
  canvas.addEventListener("pointermove", (event) => {
    clearTimeout(timer);
    onLeave();
    if (event.buttons !== 0 || event.pointerType === "touch") return;
    timer = window.setTimeout(() => onPoint(event.clientX, event.clientY, false), REST);
  });
  canvas.addEventListener("pointerleave", () => {
    clearTimeout(timer);
    onLeave();
  });
  canvas.addEventListener("pointerdown", (event) => {
    clearTimeout(timer);
    down = event.isPrimary && event.button === 0 ? event : undefined;
  });
  canvas.addEventListener("pointerup", (event) => {
    if (down === undefined) return;
    const moved = Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY);
    down = undefined;
    if (moved <= CLICK_TOLERANCE) onPoint(event.clientX, event.clientY, true);
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    // A field that this opens begins no line by it.
    event.preventDefault();
    const at = middle();
    if (at !== undefined) onPoint(...at, true);
  });
}
