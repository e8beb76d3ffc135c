// Where in a view the models are shown: in the free part in which they are seen from the least distance.
import type { OrthographicCamera, PerspectiveCamera } from "three";
import { nearest, type Part } from "./free.ts";
import { BESIDE, inHalf, showInHalf } from "./wipe.ts";

/** A view: its size in CSS pixels, what lies over it, and whether it is shown twice, side by side. */
export interface Shown {
  size: readonly [width: number, height: number];
  over: readonly Part[];
  isBeside: boolean;
}

/**
 * Shows the middle of what cameras see in that part; returns the distance, which depends on the part's width and
 * height as parts of the whole that cameras see.
 */
export function settle(
  cameras: readonly (PerspectiveCamera | OrthographicCamera)[],
  { size, over, isBeside }: Shown,
  distanceIn: (free: [width: number, height: number]) => number,
): number {
  const [width, height] = size;
  if (isBeside) {
    const middle = width / 2;
    const halves = over.map((part) => inHalf(part, middle));
    const { part, distance } = nearest([middle, height], halves, ([across, down]) =>
      distanceIn([across / (2 * BESIDE), down / BESIDE]),
    );
    for (const camera of cameras) showInHalf(camera, size, middleOf(part));
    return distance;
  }
  const { part, distance } = nearest(size, over, distanceIn);
  const [x, y] = middleOf(part);
  for (const camera of cameras) {
    camera.setViewOffset(width, height, width / 2 - x, height / 2 - y, width, height);
  }
  return distance;
}

const middleOf = ({ left, right, top, bottom }: Part): [x: number, y: number] => [
  (left + right) / 2,
  (top + bottom) / 2,
];
