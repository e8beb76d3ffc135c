// The position of A: three translations and three angles, in numbers.
import { batch, computed } from "@preact/signals-core";
import { Vector3 } from "three";
import { onChange } from "../state/store.ts";
import type { Placement } from "../worker/protocol.ts";
import { NumberInput } from "./numberInput.ts";

/** The resolution of a computed position, in diagonals and in degrees: the accuracy of a distance. */
const RESOLUTION = 1e-9;
const ANGLE_RESOLUTION = 1e-7;

const AXES = ["x", "y", "z"] as const;
const moves = AXES.map((axis) => new NumberInput(`move-${axis}`, axis));
const turns = AXES.map((axis) => new NumberInput(`turn-${axis}`, `turn-${axis}`));

const vector = (inputs: NumberInput[]): Vector3 =>
  new Vector3(...inputs.map(({ value }) => value.value));

/** The position of A. */
export const position = computed(() => ({
  /** The translation, in model units. */
  move: vector(moves),
  /** The angles about the axes x, y and z, in degrees. */
  angles: vector(turns),
}));

/** Whether A is where its file places it. */
export const isInPlace = computed(() =>
  [...moves, ...turns].every(({ value }) => value.value === 0),
);

/** Whether the position is set with models that are new, of which nothing was measured yet. */
let isPlacing = false;

/** Shows the position of a new A. `diagonal` converts the placement to model units. */
export function setPlacement({ move, turn }: Placement, diagonal: number): void {
  isPlacing = true;
  for (const input of moves) input.unit = diagonal;
  setPosition(new Vector3(...move).multiplyScalar(diagonal), new Vector3(0, 0, turn));
  isPlacing = false;
}

/** Moves A: a translation in model units and angles in degrees. */
export function setPosition(move: Vector3, angles: Vector3): void {
  batch(() => {
    for (const [axis, input] of moves.entries()) input.set(move.getComponent(axis));
    for (const [axis, input] of turns.entries()) input.set(angles.getComponent(axis));
  });
}

/** Moves A to a computed position, which the few digits of a slider would not hold. */
export function setComputedPosition(move: Vector3, angles: Vector3): void {
  batch(() => {
    for (const [axis, input] of moves.entries()) {
      input.setComputed(move.getComponent(axis), RESOLUTION * input.unit);
    }
    for (const [axis, input] of turns.entries()) {
      input.setComputed(angles.getComponent(axis), ANGLE_RESOLUTION);
    }
  });
}

/** Calls back whenever A is moved, once for all its numbers. */
export function onPosition(callback: () => void): void {
  onChange(
    () => position.value,
    () => {
      if (!isPlacing) callback();
    },
  );
}
