// What of a section's plane its plot shows, with one scale along both directions.

/** The rectangle that is plotted, in the plane's coordinates with y upwards. */
export interface Frame {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** The box of points; undefined where there is none. */
export function frameOf(points: readonly { x: number; y: number }[]): Frame | undefined {
  const [first] = points;
  if (first === undefined) return undefined;
  const frame = { left: first.x, right: first.x, bottom: first.y, top: first.y };
  for (const { x, y } of points) {
    if (x < frame.left) frame.left = x;
    if (x > frame.right) frame.right = x;
    if (y < frame.bottom) frame.bottom = y;
    if (y > frame.top) frame.top = y;
  }
  return frame;
}

/** A frame that is wider by a margin on all sides, and then as wide or high as a part of the page of this size is. */
export function fitted(
  { left, right, bottom, top }: Frame,
  margin: number,
  [width, height]: readonly [number, number],
): Frame {
  const [across, up] = [right - left + 2 * margin, top - bottom + 2 * margin];
  const unit = Math.max(across / Math.max(1, width), up / Math.max(1, height));
  const [x, y] = [(left + right) / 2, (bottom + top) / 2];
  const [halfAcross, halfUp] = [(unit * Math.max(1, width)) / 2, (unit * Math.max(1, height)) / 2];
  return { left: x - halfAcross, right: x + halfAcross, bottom: y - halfUp, top: y + halfUp };
}
