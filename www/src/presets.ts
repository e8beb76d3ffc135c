// Pairs of shapes to begin with, and where A stands.
export interface Preset {
  title: string;
  a: string;
  b: string;
  /** Where A is moved, in diagonals of the pair. */
  move: [x: number, y: number, z: number];
  /** Degrees that A is turned about its vertical axis. */
  turn?: number;
}

export const presets: Preset[] = [
  { title: "Two wavy sheets", a: "wavy-sheet", b: "wavy-sheet-b", move: [0, 0, 0.06] },
  { title: "Concentric spheres", a: "sphere", b: "sphere-larger", move: [0, 0, 0] },
  { title: "Wing sections, NACA", a: "naca-wing", b: "naca-wing-thicker", move: [0, 0, 0] },
  { title: "Glass and bottle", a: "glass", b: "bottle", move: [0.04, 0, 0] },
  {
    title: "Bottle, moved and turned",
    a: "bottle",
    b: "bottle",
    move: [0.06, 0.02, 0.03],
    turn: 12,
  },
  { title: "Hulls after Wigley", a: "wigley-hull", b: "wigley-hull-wider", move: [0, 0, 0] },
  { title: "Tori, one fatter", a: "torus", b: "torus-fatter", move: [0, 0, 0] },
  { title: "Torus, moved", a: "torus", b: "torus", move: [0.12, 0.05, 0.08] },
  { title: "Cone and cylinder", a: "cone", b: "cylinder", move: [0.05, 0, 0] },
  {
    title: "The paper's Fig. 5: plane across a cylinder",
    a: "fig5-plane",
    b: "fig5-cylinder",
    move: [0, 0, 0],
  },
];
