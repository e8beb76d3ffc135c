// A view of which a part shows one model and the rest the other one: over each other, or side by side.
import type { OrthographicCamera, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import type { Part } from "./free.ts";

/** The size of a view beside another one: what filled the whole fills nearly a half. */
export const BESIDE = 0.52;

/** A border across the view. */
export interface Wipe {
  /** The part of the view that is left of it. */
  fraction: number;
  /** Whether what is left and right of it is the same view, each in its own part. */
  isBeside: boolean;
  /** Shows what belongs left of it, right of it, or with `undefined` everywhere. */
  only: (left: boolean | undefined) => void;
}

type Size = readonly [width: number, height: number];

/** Draws what is left of the border and what is right of it. */
export function renderWiped(
  renderer: WebGLRenderer,
  { scene, camera }: { scene: Scene; camera: PerspectiveCamera | OrthographicCamera },
  [width, height]: Size,
  { fraction, isBeside, only }: Wipe,
): void {
  const border = Math.round(fraction * width);
  renderer.setScissorTest(true);
  for (const left of [true, false]) {
    const [from, own] = left ? [0, border] : [border, width - border];
    renderer.setScissor(from, 0, own, height);
    if (isBeside) renderer.setViewport(from, 0, own, height);
    only(left);
    renderer.render(scene, camera);
  }
  only(undefined);
  if (isBeside) renderer.setViewport(0, 0, width, height);
  renderer.setScissorTest(false);
}

/** Has a camera show a smaller view of the same shape in a half of the view, with its middle at a place of the half. */
export function showInHalf(
  camera: PerspectiveCamera | OrthographicCamera,
  [width, height]: Size,
  [across, down]: readonly [number, number],
): void {
  const [wide, high] = [BESIDE * width, BESIDE * height];
  camera.setViewOffset(wide, high, wide / 2 - across, high / 2 - down, width / 2, height);
}

/** Where a part of the view is in its half; one in both halves takes the whole width of each. */
export function inHalf(part: Part, middle: number): Part {
  if (part.right <= middle) return part;
  if (part.left < middle) return { ...part, left: 0, right: middle };
  return { ...part, left: part.left - middle, right: part.right - middle };
}
