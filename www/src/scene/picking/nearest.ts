// The place nearest to another one where there is something to pick: the keyboard has no pointer to aim with.

type Place = readonly [x: number, y: number];

/** Pixels between rings about the place, and the places on each. */
const STEP = 12;
const ON_A_RING = 16;
/** Rings that are tried: as far as a view reaches. */
const RINGS = 40;

/** Returns the place that is hit and nearest to this one, to the distance of rings, or else this one. */
export function nearestHit([x, y]: Place, isHit: (at: Place) => boolean): Place {
  if (isHit([x, y])) return [x, y];
  for (let ring = 1; ring <= RINGS; ring++) {
    for (let turn = 0; turn < ON_A_RING; turn++) {
      const angle = (2 * Math.PI * turn) / ON_A_RING;
      const at: Place = [x + ring * STEP * Math.cos(angle), y + ring * STEP * Math.sin(angle)];
      if (isHit(at)) return at;
    }
  }
  return [x, y];
}
