// Pairs of shapes to choose from, with the initial position of A.
import { texts } from "../texts/index.ts";
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
    title: texts.files.bracketAndItsRevision,
    ...{ a: "bracket", b: "bracket-revised", placement: IN_PLACE, allowed: 0.2 },
  },
  { title: texts.files.concentricSpheres, a: "sphere", b: "sphere-larger", placement: IN_PLACE },
  {
    title: texts.files.nacaWingsAnd,
    a: "naca-wing",
    b: "naca-wing-thicker",
    placement: IN_PLACE,
  },
  { title: texts.files.glassAndBottle, a: "glass", b: "bottle", placement: moved(0.04, 0, 0) },
  {
    title: texts.files.bottleAndCopyMovedAnd,
    a: "bottle",
    b: "bottle",
    placement: moved(0.06, 0.02, 0.03, 12),
  },
  {
    title: texts.files.twoWigleyHulls,
    a: "wigley-hull",
    b: "wigley-hull-wider",
    placement: IN_PLACE,
  },
  {
    title: texts.files.twoToriOfDifferentThickness,
    a: "torus",
    b: "torus-fatter",
    placement: IN_PLACE,
  },
  {
    title: texts.files.torusAndMovedCopy,
    a: "torus",
    b: "torus",
    placement: moved(0.12, 0.05, 0.08),
  },
  { title: texts.files.coneAndCylinder, a: "cone", b: "cylinder", placement: moved(0.05, 0, 0) },
  {
    title: texts.files.planeAndCylinderPaperFig,
    a: "fig5-plane",
    b: "fig5-cylinder",
    placement: IN_PLACE,
  },
  {
    title: texts.files.experimentsTwoWavySheets,
    ...{ a: "wavy-sheet", b: "wavy-sheet-b", placement: moved(0, 0, 0.06) },
  },
];
