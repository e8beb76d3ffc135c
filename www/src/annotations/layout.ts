// Where the labels of annotations stand: beside their points, within the view, and not over each other.

/** A label's point in the view and its size, in pixels. */
export interface Labelled {
  at: readonly [x: number, y: number];
  size: readonly [width: number, height: number];
}

/** The left upper corner of a label. */
export type Corner = readonly [left: number, top: number];

/** Pixels from a point to its label, across and up, and between labels. */
const AWAY = { across: 26, up: 22 };
const APART = 6;
/** Pixels between a label and the edge of the view. */
const MARGIN = 6;

/**
 * Returns the corners of labels in a view of this size: to the right and above their points, or to the left
 * where there is no room; from the top to the bottom each below those that it would cover. O(n²).
 */
export function cornersOf(
  all: readonly Labelled[],
  [width, height]: readonly [number, number],
): Corner[] {
  const corners: Corner[] = [];
  const placed: { corner: Corner; size: Labelled["size"] }[] = [];
  const inOrder = [...all.keys()].sort(
    (one, two) => (all[one]?.at[1] ?? 0) - (all[two]?.at[1] ?? 0),
  );
  for (const index of inOrder) {
    const label = all[index];
    if (label === undefined) continue;
    const { at, size } = label;
    const right = at[0] + AWAY.across;
    const left = at[0] - AWAY.across - size[0];
    const across = right + size[0] + MARGIN > width && left >= MARGIN ? left : right;
    let corner: Corner = [
      within(across, size[0], width),
      within(at[1] - AWAY.up - size[1], size[1], height),
    ];
    for (const other of placed) {
      if (!isOver({ corner, size }, other)) continue;
      corner = [corner[0], other.corner[1] + other.size[1] + APART];
    }
    corners[index] = corner;
    placed.push({ corner, size });
    // Those below are compared from the top again.
    placed.sort((one, two) => one.corner[1] - two.corner[1]);
  }
  return corners;
}

/** The end of the leader from a point: the middle of the label's nearer side. */
export function leaderEnd({ at, size }: Labelled, [left, top]: Corner): [x: number, y: number] {
  const x = at[0] < left ? left : at[0] > left + size[0] ? left + size[0] : at[0];
  const inside = x > left && x < left + size[0];
  return [x, inside ? (at[1] < top ? top : top + size[1]) : top + size[1] / 2];
}

const within = (at: number, length: number, end: number): number =>
  Math.max(MARGIN, Math.min(at, end - length - MARGIN));

type Box = { corner: Corner; size: Labelled["size"] };

const isOver = (one: Box, two: Box): boolean =>
  [0, 1].every((axis) => {
    const [from, other] = [one.corner[axis] ?? 0, two.corner[axis] ?? 0];
    return (
      from < other + (two.size[axis] ?? 0) + APART && other < from + (one.size[axis] ?? 0) + APART
    );
  });
