// A view of which a part shows one model and the rest the other one: over each other, or side by side.
import type { OrthographicCamera, PerspectiveCamera, Scene, WebGLRenderer } from "three";

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

/** Has a camera show the middle of a smaller view of the same shape in a half of the view. */
export function showInHalf(
  camera: PerspectiveCamera | OrthographicCamera,
  [width, height]: Size,
): void {
  const [wide, high] = [BESIDE * width, BESIDE * height];
  const [x, y] = [wide / 2 - width / 4, (high - height) / 2];
  camera.setViewOffset(wide, high, x, y, width / 2, height);
}
