// The names of units of length.
const NAMES: readonly (readonly [metres: number, name: string])[] = [
  [1e-9, "nm"],
  [1e-6, "µm"],
  [2.54e-5, "mil"],
  [1e-3, "mm"],
  [1e-2, "cm"],
  [0.0254, "in"],
  [0.1, "dm"],
  [0.3048, "ft"],
  [0.9144, "yd"],
  [1, "m"],
  [1e3, "km"],
];

/** The relative difference up to which a length counts as a unit: files state few digits. */
const RELATIVE_TOLERANCE = 1e-6;

/** Returns the symbol of the unit of this many metres, or the number of metres. */
export function unitName(metres: number): string {
  const known = NAMES.find(([size]) => Math.abs(metres - size) <= RELATIVE_TOLERANCE * size);
  return known?.[1] ?? `${metres} m`;
}
