// Pairs of shapes to choose from, with the initial position of A.
import type { Placement } from "../worker/protocol.ts";

export interface Preset {
  title: string;
  /** Names of the package's shapes. */
  a: string;
  b: string;
  placement: Placement;
  /** The allowed deviation to begin with. */
  allowed?: number;
}

/** The shapes at the positions in which they are constructed. */
export const IN_PLACE: Placement = { move: [0, 0, 0], turn: 0 };

const moved = (x: number, y: number, z: number, turn = 0): Placement => ({ move: [x, y, z], turn });

export const presets: readonly Preset[] = [
  {
    title: "Bracket and its revision",
    ...{ a: "bracket", b: "bracket-revised", placement: IN_PLACE, allowed: 0.2 },
  },
  { title: "Concentric spheres", a: "sphere", b: "sphere-larger", placement: IN_PLACE },
  {
    title: "NACA wings 2412 and 2415",
    a: "naca-wing",
    b: "naca-wing-thicker",
    placement: IN_PLACE,
  },
  { title: "Glass and bottle", a: "glass", b: "bottle", placement: moved(0.04, 0, 0) },
  {
    title: "Bottle and copy, moved and rotated",
    a: "bottle",
    b: "bottle",
    placement: moved(0.06, 0.02, 0.03, 12),
  },
  { title: "Two Wigley hulls", a: "wigley-hull", b: "wigley-hull-wider", placement: IN_PLACE },
  { title: "Two tori of different thickness", a: "torus", b: "torus-fatter", placement: IN_PLACE },
  { title: "Torus and moved copy", a: "torus", b: "torus", placement: moved(0.12, 0.05, 0.08) },
  { title: "Cone and cylinder", a: "cone", b: "cylinder", placement: moved(0.05, 0, 0) },
  {
    title: "Plane and cylinder (2012 paper, Fig. 5)",
    a: "fig5-plane",
    b: "fig5-cylinder",
    placement: IN_PLACE,
  },
  {
    title: "Experiments: two wavy sheets",
    ...{ a: "wavy-sheet", b: "wavy-sheet-b", placement: moved(0, 0, 0.06) },
  },
];
