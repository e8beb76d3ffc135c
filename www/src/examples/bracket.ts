// A bracket and its revision, in millimetres: an angle of two plates with a fillet, three bores
// and a rounded back, of planes and cylinders.
import type { InterchangeModel } from "nurbs-hausdorff";
import { bore, type Corner, type Plane, planeFace, quarter } from "./faces.ts";

/** The lengths of a bracket, in millimetres. */
export interface BracketSizes {
  length: number;
  height: number;
  width: number;
  thickness: number;
  /** The radius of the fillet between the plates; the back is round about the same axis. */
  fillet: number;
  /** The bores of the base plate: their distance from the back, and their radius. */
  screws: { at: number; radius: number };
  /** The bore of the upright plate: its height and radius. */
  bearing: { at: number; radius: number };
}

export const BRACKET: BracketSizes = {
  ...{ length: 80, height: 70, width: 60, thickness: 8, fillet: 6 },
  ...{ screws: { at: 55, radius: 4.5 }, bearing: { at: 45, radius: 14 } },
};

/** A longer base plate, screws that moved with it, and a bearing of another size. */
export const REVISED: BracketSizes = {
  ...BRACKET,
  length: 80.35,
  screws: { at: 55.3, radius: 4.5 },
  bearing: { at: 45, radius: 13.9 },
};

const METRES = 0.001;

/** Returns the bracket as interchange JSON; all faces are named, and their normals point outwards. */
export function bracket(name: string, sizes: BracketSizes): InterchangeModel {
  const { length, height, width, thickness, fillet, screws, bearing } = sizes;
  const axis = thickness + fillet;
  // The profile is in the plane of x and z: u is x and v is z, and the normal is −y.
  const profile: Corner[] = [
    { at: [axis, 0] },
    { at: [length, 0] },
    { at: [length, thickness] },
    { at: [axis, thickness], about: [axis, axis] },
    { at: [thickness, axis] },
    { at: [thickness, height] },
    { at: [0, height] },
    { at: [0, axis], about: [axis, axis] },
  ];
  const front: Plane = { origin: [0, 0, 0], u: [1, 0, 0], v: [0, 0, 1] };
  // Seen from behind: u is −x.
  const back: Plane = { origin: [0, width, 0], u: [-1, 0, 0], v: [0, 0, 1] };
  const mirrored = profile.map(({ at: [x, z] }, index): Corner => {
    const about = profile[(index + profile.length - 1) % profile.length]?.about;
    return { at: [-x, z], ...(about && { about: [-about[0], about[1]] }) };
  });
  const plates = { ...sizes, axis };
  return {
    ...{ name, unit: METRES },
    surfaces: [
      planeFace("side front", front, profile),
      planeFace("side back", back, mirrored.reverse()),
      ...basePlate(plates),
      ...uprightPlate(plates),
      quarter(
        "fillet",
        front,
        { from: [axis, thickness], to: [thickness, axis], about: [axis, axis] },
        [0, width, 0],
      ),
      quarter("round back", front, { from: [0, axis], to: [axis, 0], about: [axis, axis] }, [
        0,
        width,
        0,
      ]),
      ...[0.25, 0.75].map((part, index) =>
        bore(
          `screw bore ${index + 1}`,
          BOTTOM,
          { at: [part * width, screws.at], radius: screws.radius },
          [0, 0, thickness],
        ),
      ),
      bore("bearing bore", REAR, { at: [bearing.at, width / 2], radius: bearing.radius }, [
        thickness,
        0,
        0,
      ]),
    ],
  };
}

/** Seen from below: u is y and v is x. */
const BOTTOM: Plane = { origin: [0, 0, 0], u: [0, 1, 0], v: [1, 0, 0] };
/** Seen from behind the upright plate: u is z and v is y. */
const REAR: Plane = { origin: [0, 0, 0], u: [0, 0, 1], v: [0, 1, 0] };

type Plates = BracketSizes & { axis: number };

function basePlate({ length, width, thickness, axis, screws }: Plates) {
  const across = [0.25 * width, 0.75 * width];
  const holes = (turned: boolean) =>
    across.map((y) => ({
      at: (turned ? [screws.at, y] : [y, screws.at]) as [number, number],
      radius: screws.radius,
    }));
  const top: Plane = { origin: [0, 0, thickness], u: [1, 0, 0], v: [0, 1, 0] };
  const end: Plane = { origin: [length, 0, 0], u: [0, 1, 0], v: [0, 0, 1] };
  return [
    planeFace("base bottom", BOTTOM, rectangle([0, width], [axis, length]), holes(false)),
    planeFace("base top", top, rectangle([axis, length], [0, width]), holes(true)),
    planeFace("base end", end, rectangle([0, width], [0, thickness])),
  ];
}

function uprightPlate({ height, width, thickness, axis, bearing }: Plates) {
  const middle = width / 2;
  const { at, radius } = bearing;
  const inner: Plane = { origin: [thickness, 0, 0], u: [0, 1, 0], v: [0, 0, 1] };
  const top: Plane = { origin: [0, 0, height], u: [1, 0, 0], v: [0, 1, 0] };
  return [
    planeFace("upright inside", inner, rectangle([0, width], [axis, height]), [
      { at: [middle, at], radius },
    ]),
    planeFace("upright outside", REAR, rectangle([axis, height], [0, width]), [
      { at: [at, middle], radius },
    ]),
    planeFace("upright top", top, rectangle([0, thickness], [0, width])),
  ];
}

const rectangle = ([u0, u1]: [number, number], [v0, v1]: [number, number]): Corner[] => [
  { at: [u0, v0] },
  { at: [u1, v0] },
  { at: [u1, v1] },
  { at: [u0, v1] },
];
