// The parts of the view that nothing lies over: the models are shown in one of them.

/** A rectangle of the view, in CSS pixels from its left upper corner. */
export interface Part {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export const NOWHERE: Part = { left: 0, right: 0, top: 0, bottom: 0 };

/** Where an element lies over the view; nowhere while it is hidden. */
export function partOf({ offsetLeft, offsetTop, offsetWidth, offsetHeight }: HTMLElement): Part {
  const [right, bottom] = [offsetLeft + offsetWidth, offsetTop + offsetHeight];
  return { left: offsetLeft, right, top: offsetTop, bottom };
}

/** The smallest rectangle that contains two others, of which either may be nowhere. */
export function around(one: Part, other: Part): Part {
  if (isSame(one, NOWHERE)) return other;
  if (isSame(other, NOWHERE)) return one;
  return {
    left: Math.min(one.left, other.left),
    right: Math.max(one.right, other.right),
    top: Math.min(one.top, other.top),
    bottom: Math.max(one.bottom, other.bottom),
  };
}

export const isSame = (one: Part, other: Part): boolean =>
  one.left === other.left &&
  one.right === other.right &&
  one.top === other.top &&
  one.bottom === other.bottom;

/** Returns where a strip of a view begins: right of what lies over its left half. */
export const beginOf = (
  over: readonly Part[],
  [top, bottom]: readonly [number, number],
  width: number,
): number =>
  over
    .filter((part) => part.top < bottom && part.bottom > top && part.right < width / 2)
    .reduce((begin, { right }) => Math.max(begin, right), 0);

/**
 * Returns the free part of a view in which models are seen from the least distance, which depends on
 * its width and height as parts of the view's.
 */
export function nearest(
  [width, height]: readonly [number, number],
  over: readonly Part[],
  distanceIn: (free: [width: number, height: number]) => number,
): { part: Part; distance: number } {
  const seen = freeParts([width, height], over).map((part) => {
    const across = (part.right - part.left) / Math.max(1, width);
    const down = (part.bottom - part.top) / Math.max(1, height);
    return { part, distance: distanceIn([across, down]) };
  });
  return seen.reduce((one, other) => (other.distance < one.distance ? other : one));
}

/** The least part of the view's width and of its height that is left to the models. */
const MIN_FREE = 0.3;

/**
 * Returns the largest parts of a view that are free of what lies over it. What would leave none
 * that is large enough is not heeded; the first are the most important.
 */
function freeParts(
  [width, height]: readonly [number, number],
  over: readonly Part[],
): readonly Part[] {
  const isLarge = ({ left, right, top, bottom }: Part) =>
    right - left >= MIN_FREE * width && bottom - top >= MIN_FREE * height;
  let parts: Part[] = [{ left: 0, right: width, top: 0, bottom: height }];
  for (const one of over) {
    const free = parts.flatMap((part) => beside(part, one)).filter(isLarge);
    if (free.length > 0) parts = free;
  }
  return parts;
}

/** The largest rectangles of a part that have nothing in common with another one. */
function beside(part: Part, other: Part): Part[] {
  const isApart =
    other.right <= Math.max(part.left, other.left) ||
    other.bottom <= Math.max(part.top, other.top) ||
    other.left >= part.right ||
    other.top >= part.bottom;
  if (isApart) return [part];
  return [
    { ...part, right: other.left },
    { ...part, left: other.right },
    { ...part, bottom: other.top },
    { ...part, top: other.bottom },
  ];
}
