// Where the labels of annotations stand: beside their points, within the view, and over nothing else.

/** A label's point in the view and its size, in pixels. */
export interface Labelled {
  at: readonly [x: number, y: number];
  size: readonly [width: number, height: number];
}

/** The left upper corner of a label. */
export type Corner = readonly [left: number, top: number];

/** A box in the view, in pixels. */
export interface Box {
  corner: Corner;
  size: Labelled["size"];
}

/** Pixels from a point to its label, across and up, and between labels. */
const AWAY = { across: 26, up: 22 };
const APART = 6;
/** Pixels between a label and the edge of the view. */
const MARGIN = 6;
/** Heights of itself by which a label is moved up or down to where there is room. */
const STEPS = [0, 1, -1, 2, -2, 3, -3, 4, -4] as const;

/**
 * Returns the corners of labels in a view of this size: to the right and above their points, or else to the left, right
 * above or below, or farther up or down, where nothing is in the way; where there is no room at all, to the right and above.
 * O(n²).
 */
export function cornersOf(
  all: readonly Labelled[],
  view: readonly [width: number, height: number],
  others: readonly Box[] = [],
): Corner[] {
  const taken = [...others];
  return all.map((label) => {
    const { size } = label;
    const tried = candidates(label, view).filter((corner) => !isOn({ corner, size }, label.at));
    const free = tried.find((corner) => taken.every((other) => !isOver({ corner, size }, other)));
    const corner = free ?? tried[0] ?? [MARGIN, MARGIN];
    taken.push({ corner, size });
    return corner;
  });
}

/** The places for a label, the best first. */
function candidates({ at, size }: Labelled, view: readonly [number, number]): Corner[] {
  const [width, height] = size;
  const beside = [at[0] + AWAY.across, at[0] - AWAY.across - width];
  const inView = beside.filter((left) => left >= MARGIN && left + width + MARGIN <= view[0]);
  const lefts = [...inView, within(at[0] - width / 2, width, view[0])];
  return STEPS.flatMap((step) =>
    [-AWAY.up - height, AWAY.up].flatMap((down) =>
      lefts.map((left): Corner => {
        const top = at[1] + down + step * (height + APART);
        return [left, within(top, height, view[1])];
      }),
    ),
  );
}

/** The end of the leader from a point: the middle of the label's nearer side. */
export function leaderEnd({ at, size }: Labelled, [left, top]: Corner): [x: number, y: number] {
  const x = at[0] < left ? left : at[0] > left + size[0] ? left + size[0] : at[0];
  const inside = x > left && x < left + size[0];
  return [x, inside ? (at[1] < top ? top : top + size[1]) : top + size[1] / 2];
}

const within = (at: number, length: number, end: number): number =>
  Math.max(MARGIN, Math.min(at, end - length - MARGIN));

/** Whether a point is beneath a box. */
const isOn = ({ corner, size }: Box, at: Labelled["at"]): boolean =>
  [0, 1].every((axis) => {
    const from = corner[axis] ?? 0;
    return (at[axis] ?? 0) >= from && (at[axis] ?? 0) <= from + (size[axis] ?? 0);
  });

const isOver = (one: Box, two: Box): boolean =>
  [0, 1].every((axis) => {
    const [from, other] = [one.corner[axis] ?? 0, two.corner[axis] ?? 0];
    const [length, otherLength] = [one.size[axis] ?? 0, two.size[axis] ?? 0];
    return from < other + otherLength + APART && other < from + length + APART;
  });
