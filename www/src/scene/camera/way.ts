// The camera's way from one view to another, around what it looks at.
import type { PerspectiveCamera, Vector3 } from "three";

/** Milliseconds of the way. */
const WAY = 280;

/** A view: what is looked at, the direction from there to the eye, and the distance. */
export interface LookedAt {
  target: Vector3;
  direction: Vector3;
  distance: number;
}

/** What a way moves. */
interface Moved {
  camera: PerspectiveCamera;
  target: Vector3;
  /** Called after each step. */
  onStep: () => void;
}

export class Way {
  readonly #moved: Moved;
  #frame = 0;

  constructor(moved: Moved) {
    this.#moved = moved;
  }

  /** Ends the way where it is. */
  end(): void {
    cancelAnimationFrame(this.#frame);
  }

  /** Moves the camera to where it sees a target from a direction at a distance. */
  to({ target, direction, distance }: LookedAt, atOnce: boolean): void {
    this.end();
    const eye = target.clone().addScaledVector(direction, distance);
    // What is nowhere cannot be looked at, and a camera that is nowhere would not come back.
    if (![...eye.toArray(), ...target.toArray()].every(Number.isFinite)) return;
    const { camera, target: current, onStep } = this.#moved;
    const { position } = camera;
    const [fromEye, fromTarget] = [position.clone(), current.clone()];
    const begin = performance.now();
    const still = atOnce || fromEye.equals(fromTarget) || isStill();
    const step = () => {
      const part = still ? 1 : Math.min(1, (performance.now() - begin) / WAY);
      // Starts and ends slowly.
      const eased = part * part * (3 - 2 * part);
      current.lerpVectors(fromTarget, target, eased);
      position.lerpVectors(fromEye, eye, eased);
      // Around the target rather than through it.
      const around = lerp(fromEye.distanceTo(fromTarget), distance, eased);
      position.sub(current);
      // Halfway to the opposite side, no direction is left.
      if (position.lengthSq() === 0) position.copy(direction);
      position.setLength(around).add(current);
      // The same view is the same wherever the way to it began.
      if (part === 1) {
        current.copy(target);
        position.copy(eye);
      }
      onStep();
      if (part < 1) this.#frame = requestAnimationFrame(step);
    };
    step();
  }
}

const lerp = (from: number, to: number, part: number): number => from + part * (to - from);

/** Whether the user wants no motion. */
const isStill = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;
