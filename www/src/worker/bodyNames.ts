// The names of bodies as the parts of a comparison have them.
import type { Body } from "nurbs-hausdorff";

/** Returns the names of a model's bodies: the names of their levels, else their number; equal names are numbered. */
export function bodyNames(bodies: readonly Pick<Body, "path">[]): string[] {
  const taken = new Set<string>();
  return bodies.map(({ path }, index) => {
    const name = path.length === 0 ? `body ${index + 1}` : path.map(level).join(" / ");
    let candidate = name;
    for (let number = 2; taken.has(candidate); number++) candidate = `${name} (${number})`;
    taken.add(candidate);
    return candidate;
  });
}

/** The name of a level as it stands in a joined name: a word of slashes has one more there. */
const level = (name: string): string =>
  name
    .split(" ")
    .map((word) => (/^\/+$/.test(word) ? `${word}/` : word))
    .join(" ");
