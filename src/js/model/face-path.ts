// Names of faces in assemblies: the names of all levels with " / " between them.

/**
 * Returns the names of the levels in the name of a face, from the outermost to the face's own:
 * `"pump / housing / face 3"` has three. A word of slashes in a level's own name stands in the joined
 * name with one more: `"in // out"` is the one level `in / out`.
 */
export function facePath(name: string): string[] {
  const levels: string[][] = [[]];
  for (const word of name.split(" ")) {
    if (word === "/") levels.push([]);
    else levels.at(-1)?.push(isSlashes(word) ? word.slice(1) : word);
  }
  return levels.map((words) => words.join(" "));
}

/**
 * Returns the name of a level as it stands in a joined name.
 * @internal
 */
export function level(name: string): string {
  const words = name.split(" ").map((word) => (isSlashes(word) ? `${word}/` : word));
  return words.join(" ");
}

const isSlashes = (word: string): boolean => /^\/+$/.test(word);
