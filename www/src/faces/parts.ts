// The parts of an assembly, from the names of its faces: readers name them `assembly / part / face`.
import { facePath } from "nurbs-hausdorff";

/** A part or an assembly where it stands once. */
export interface Part {
  /** The names of this level and of those above, from the outermost. */
  path: string[];
  /** All faces below it. */
  faces: number[];
  /** Its parts, and the faces that stand in it themselves, in the order of the file. */
  items: (Part | number)[];
}

/** Returns the name of a face without those of its parts. */
export const ownName = (name: string): string => facePath(name).at(-1) ?? name;

/**
 * Returns the parts and faces at the outermost level in the order of the faces; a part that stands in
 * several places under one name is numbered from its second on. O(n) for each level and each divisor
 * of the number of faces.
 */
export function partsOf(names: readonly string[]): Part["items"] {
  const paths = names.map(facePath);
  return itemsOf([...names.keys()], [], names, paths);
}

/** The parts and faces among these faces, which all stand in the levels of `above`. */
function itemsOf(
  faces: readonly number[],
  above: string[],
  names: readonly string[],
  paths: readonly string[][],
): Part["items"] {
  const depth = above.length;
  const levelOf = (face: number) => paths[face]?.slice(0, -1)[depth];
  const runs: number[][] = [];
  for (const face of faces) {
    const last = runs.at(-1);
    const level = levelOf(face);
    if (level !== undefined && last?.[0] !== undefined && levelOf(last[0]) === level) {
      last.push(face);
    } else runs.push([face]);
  }
  const counts = new Map<string, number>();
  return runs.flatMap((run): Part["items"] => {
    const level = levelOf(run[0] ?? 0);
    if (level === undefined) return run;
    return copies(run, names).map((own): Part => {
      const count = (counts.get(level) ?? 0) + 1;
      counts.set(level, count);
      const path = [...above, count > 1 ? `${level} (${count})` : level];
      const items = itemsOf(own, path, names, paths);
      const [only] = items;
      // A part in which another one stands alone is one row with it.
      return items.length === 1 && typeof only === "object" ? only : { path, faces: own, items };
    });
  });
}

/** The faces of copies that follow each other: the shortest sequence of names that is repeated. */
function copies(faces: number[], names: readonly string[]): number[][] {
  const at = (index: number) => names[faces[index] ?? 0];
  for (let length = 2; 2 * length <= faces.length; length++) {
    if (faces.length % length !== 0) continue;
    if (faces.some((_, index) => index >= length && at(index) !== at(index - length))) continue;
    // Faces that are all called the same are no copies.
    if (at(0) === at(1)) break;
    const count = faces.length / length;
    return Array.from({ length: count }, (_, copy) =>
      faces.slice(copy * length, (copy + 1) * length),
    );
  }
  return [faces];
}
