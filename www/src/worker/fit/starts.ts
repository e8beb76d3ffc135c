// The positions from which a best fit starts: where A is, and A's principal axes on B's.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import type { Principal } from "./principal.ts";

/** The part of the largest spread by which two may differ and still be taken for one another. */
const ALIKE = 0.15;

/** Returns the rigid transforms that lay A's principal axes on B's, for B scaled by `scale`. */
export function startsOf(a: Principal, b: Principal, scale: number): Transform[] {
  const spreads = b.spreads.map((spread) => scale * scale * spread) as Vector3;
  const largest = Math.max(...a.spreads, ...spreads);
  return rightHanded().flatMap((onto) => {
    const fits = onto.every(({ axis }, index) => {
      const difference = Math.abs((a.spreads[index] ?? 0) - (spreads[axis] ?? 0));
      return difference <= ALIKE * largest;
    });
    return fits ? [transformOf(a, b, onto, scale)] : [];
  });
}

/** Which axis of B one of A's lies on, and in which direction. */
interface Onto {
  axis: number;
  sign: 1 | -1;
}

/** The 24 ways in which right-handed axes lie on others. */
function rightHanded(): Onto[][] {
  const orders = [
    { order: [0, 1, 2], parity: 1 },
    { order: [1, 2, 0], parity: 1 },
    { order: [2, 0, 1], parity: 1 },
    { order: [0, 2, 1], parity: -1 },
    { order: [2, 1, 0], parity: -1 },
    { order: [1, 0, 2], parity: -1 },
  ];
  const signs: readonly (1 | -1)[] = [1, -1];
  return orders.flatMap(({ order, parity }) =>
    signs.flatMap((x) =>
      signs.map((y): Onto[] => {
        const all = [x, y, (parity * x * y) as 1 | -1];
        return order.map((axis, index) => ({ axis, sign: all[index] ?? 1 }));
      }),
    ),
  );
}

function transformOf(a: Principal, b: Principal, onto: Onto[], scale: number): Transform {
  // The rotation's rows: the sum over the axes of B's, with its sign, times A's.
  const rows = [0, 1, 2].map((row) =>
    [0, 1, 2].map((column) =>
      onto.reduce((sum, { axis, sign }, index) => {
        return sum + sign * (b.axes[axis]?.[row] ?? 0) * (a.axes[index]?.[column] ?? 0);
      }, 0),
    ),
  ) as [Vector3, Vector3, Vector3];
  const translation = rows.map((row, axis) => {
    const turned = row.reduce((sum, value, index) => sum + value * (a.middle[index] ?? 0), 0);
    return scale * (b.middle[axis] ?? 0) - turned;
  }) as Vector3;
  return { rotation: quaternionOf(rows), translation };
}

/** The unit quaternion x, y, z, w of a rotation, by its largest component. */
function quaternionOf([[a, b, c], [d, e, f], [g, h, i]]: readonly [Vector3, Vector3, Vector3]) {
  const candidates: [number, number, number, number][] = [
    [1 + a - e - i, b + d, c + g, h - f],
    [b + d, 1 - a + e - i, f + h, c - g],
    [c + g, f + h, 1 - a - e + i, d - b],
    [h - f, c - g, d - b, 1 + a + e + i],
  ];
  const sizes = candidates.map((one) => Math.hypot(...one));
  const best = candidates[sizes.indexOf(Math.max(...sizes))] ?? [0, 0, 0, 1];
  const length = Math.hypot(...best) || 1;
  return best.map((value) => value / length) as [number, number, number, number];
}
