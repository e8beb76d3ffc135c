// Pairs of shapes to begin with, and where A stands.
import type { Placement } from "./protocol.ts";

export interface Preset {
  title: string;
  /** Names of the package's shapes. */
  a: string;
  b: string;
  placement: Placement;
}

/** Where the shapes are made. */
export const IN_PLACE: Placement = { move: [0, 0, 0], turn: 0 };

const moved = (x: number, y: number, z: number, turn = 0): Placement => ({ move: [x, y, z], turn });

export const presets: readonly Preset[] = [
  { title: "Two wavy sheets", a: "wavy-sheet", b: "wavy-sheet-b", placement: moved(0, 0, 0.06) },
  { title: "Concentric spheres", a: "sphere", b: "sphere-larger", placement: IN_PLACE },
  {
    title: "Wings, NACA 2412 and 2415",
    a: "naca-wing",
    b: "naca-wing-thicker",
    placement: IN_PLACE,
  },
  { title: "Glass and bottle", a: "glass", b: "bottle", placement: moved(0.04, 0, 0) },
  {
    title: "Bottle, moved and turned",
    a: "bottle",
    b: "bottle",
    placement: moved(0.06, 0.02, 0.03, 12),
  },
  { title: "Hulls after Wigley", a: "wigley-hull", b: "wigley-hull-wider", placement: IN_PLACE },
  { title: "Tori, one fatter", a: "torus", b: "torus-fatter", placement: IN_PLACE },
  { title: "Torus, moved", a: "torus", b: "torus", placement: moved(0.12, 0.05, 0.08) },
  { title: "Cone and cylinder", a: "cone", b: "cylinder", placement: moved(0.05, 0, 0) },
  {
    title: "Fig. 5 of 2012: plane, cylinder",
    a: "fig5-plane",
    b: "fig5-cylinder",
    placement: IN_PLACE,
  },
];
