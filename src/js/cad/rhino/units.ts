import type { Rhino } from "./types.js";

/** Metres per unit by openNURBS' names of unit systems. */
const METRES: Readonly<Record<string, number>> = {
  Angstroms: 1e-10,
  Nanometers: 1e-9,
  Microns: 1e-6,
  Millimeters: 1e-3,
  Centimeters: 1e-2,
  Decimeters: 1e-1,
  Meters: 1,
  Dekameters: 10,
  Hectometers: 100,
  Kilometers: 1e3,
  Megameters: 1e6,
  Gigameters: 1e9,
  Microinches: 2.54e-8,
  Mils: 2.54e-5,
  Inches: 0.0254,
  Feet: 0.3048,
  Yards: 0.9144,
  Miles: 1609.344,
  PrinterPoints: 0.0254 / 72,
  PrinterPicas: 0.0254 / 6,
  NauticalMiles: 1852,
};

/** Metres per unit of a file, or null where it has none or a unit of its own. */
export function unitInMetres(rhino: Rhino, system: unknown): number | null {
  const name = Object.keys(METRES).find((name) => rhino.UnitSystem[name] === system);
  return name === undefined ? null : (METRES[name] ?? null);
}
