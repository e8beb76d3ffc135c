// The parts of an assembly, from the names of its faces: readers name them `part / face`.

/** A part where it stands once, with its faces. */
export interface Part {
  /** Empty for faces that belong to no part. */
  name: string;
  faces: number[];
}

const SEPARATOR = " / ";

/** Returns the name of a face without its part's. */
export function ownName(name: string): string {
  const at = name.indexOf(SEPARATOR);
  return at < 0 ? name : name.slice(at + SEPARATOR.length);
}

function partName(name: string): string {
  const at = name.indexOf(SEPARATOR);
  return at < 0 ? "" : name.slice(0, at);
}

/**
 * Returns the parts in the order of their faces; a part that stands in several places is numbered
 * from its second on. O(n) for each divisor of the number of faces.
 */
export function partsOf(names: readonly string[]): Part[] {
  const runs: Part[] = [];
  for (const [face, full] of names.entries()) {
    const name = partName(full);
    const last = runs.at(-1);
    if (last?.name === name) last.faces.push(face);
    else runs.push({ name, faces: [face] });
  }
  const counts = new Map<string, number>();
  return runs.flatMap(({ name, faces }) =>
    copies(faces, names).map((own) => {
      const count = (counts.get(name) ?? 0) + 1;
      counts.set(name, count);
      return { name: name !== "" && count > 1 ? `${name} (${count})` : name, faces: own };
    }),
  );
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
