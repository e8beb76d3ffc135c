// Typed arrays, one after another.

/** Returns the numbers of all parts as one array of a type. O(n). */
export function concatenated<Numbers extends Float32Array | Float64Array | Uint32Array>(
  Type: new (length: number) => Numbers,
  parts: readonly ArrayLike<number>[],
): Numbers {
  const whole = new Type(parts.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const part of parts) {
    whole.set(part, end);
    end += part.length;
  }
  return whole;
}
