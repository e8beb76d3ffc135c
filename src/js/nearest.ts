/**
 * The advice for an unknown name: the known one that is nearest, or all where none is near.
 * @internal
 */
export function nearest(key: string, known: readonly string[]): string {
  const distances = known.map((name) => editDistance(plain(key), plain(name)));
  const least = Math.min(...distances);
  const name = known[distances.indexOf(least)];
  // At least half of the letters agree.
  return name !== undefined && 2 * least <= Math.max(key.length, name.length)
    ? `did you mean ${JSON.stringify(name)}?`
    : `expected one of ${known.join(", ")}`;
}

/** A name without case and underscores, in which spellings of different formats are equal. */
const plain = (name: string): string => name.toLowerCase().replaceAll("_", "");

/** The least number of letters to insert, delete or replace (Levenshtein). O(n²). */
function editDistance(one: string, other: string): number {
  let row = Array.from({ length: other.length + 1 }, (_, length) => length);
  for (let i = 1; i <= one.length; i++) {
    const next = [i];
    for (let j = 1; j <= other.length; j++) {
      const replaced = (row[j - 1] ?? 0) + (one[i - 1] === other[j - 1] ? 0 : 1);
      next.push(Math.min(replaced, (row[j] ?? 0) + 1, (next[j - 1] ?? 0) + 1));
    }
    row = next;
  }
  return row[other.length] ?? 0;
}
