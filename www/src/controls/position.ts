// The position of A: three translations and three angles, in numbers.
import { Vector3 } from "three";
import type { Placement } from "../worker/protocol.ts";
import { NumberInput } from "./numberInput.ts";

/** The resolution of a computed position, in diagonals and in degrees: the accuracy of a distance. */
const RESOLUTION = 1e-9;
const ANGLE_RESOLUTION = 1e-7;

const AXES = ["x", "y", "z"] as const;
const moves = AXES.map((axis) => new NumberInput(`move-${axis}`));
const turns = AXES.map((axis) => new NumberInput(`turn-${axis}`));

const vector = (inputs: NumberInput[]): Vector3 => new Vector3(...inputs.map(({ value }) => value));

/** The translation of A, in model units. */
export const translation = (): Vector3 => vector(moves);

/** The angles of A about the axes x, y and z, in degrees. */
export const degrees = (): Vector3 => vector(turns);

/** Whether A is where its file places it. */
export const isInPlace = (): boolean => [...moves, ...turns].every(({ value }) => value === 0);

/** Shows the position of A. `diagonal` converts the placement to model units. */
export function setPlacement({ move, turn }: Placement, diagonal: number): void {
  for (const input of moves) input.unit = diagonal;
  setPosition(new Vector3(...move).multiplyScalar(diagonal), new Vector3(0, 0, turn));
}

/** Shows a translation in model units and angles in degrees. */
export function setPosition(move: Vector3, angles: Vector3): void {
  for (const [axis, input] of moves.entries()) input.value = move.getComponent(axis);
  for (const [axis, input] of turns.entries()) input.value = angles.getComponent(axis);
}

/** Shows a computed position, which the few digits of a slider would not hold. */
export function setComputedPosition(move: Vector3, angles: Vector3): void {
  for (const [axis, input] of moves.entries()) {
    input.setComputed(move.getComponent(axis), RESOLUTION * input.unit);
  }
  for (const [axis, input] of turns.entries()) {
    input.setComputed(angles.getComponent(axis), ANGLE_RESOLUTION);
  }
}

/** Calls back on every change of the position. */
export function onPosition(callback: () => void): void {
  for (const input of [...moves, ...turns]) input.onChange = callback;
}
