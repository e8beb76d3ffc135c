// The faces that a comparison found changed, in the view: coloured, the others grey, or one of them alone.
import type { DiffResult, Vector3 as Point } from "nurbs-hausdorff";
import { Vector3 } from "three";
import { attainedText } from "../../common/text/numbers.ts";
import { type Change, classesOf, classOf } from "../../faces/changes.ts";
import type { Side, Sides } from "../../worker/protocol.ts";
import type { FaceClass } from "../faces.ts";
import type { Models } from "../models.ts";
import type { Arrow } from "../overlays/arrow.ts";

/** A place in the scene with the size of what is there. */
export interface Around {
  center: Vector3;
  size: number;
}

export class ChangedFaces {
  readonly #models: Models;
  readonly #arrow: Arrow;
  #shown: { diff: DiffResult; side: Side | undefined } | undefined;

  constructor(models: Models, arrow: Arrow) {
    this.#models = models;
    this.#arrow = arrow;
  }

  /** Whether a comparison is shown. */
  get active(): boolean {
    return this.#shown !== undefined;
  }

  /** Colours the faces that a comparison found changed, of one model or of both; without one, ends that. */
  show(diff: DiffResult | undefined, side?: Side): void {
    this.#shown = diff && { diff, side };
    this.#models.alone = diff === undefined ? undefined : side;
    this.#models.classify(
      diff === undefined ? {} : { a: classesOf(diff, "a"), b: classesOf(diff, "b") },
    );
    if (diff !== undefined) this.#arrow.hide();
  }

  /**
   * Shows one face of the comparison with its own arrow, and greys all others; without one, shows all
   * again. Returns where it is.
   */
  select(change: Change | undefined): Around | undefined {
    if (this.#shown === undefined) return undefined;
    const { diff, side: both } = this.#shown;
    if (change === undefined) {
      this.show(diff, both);
      return undefined;
    }
    const { side, difference, kind } = change;
    this.#models.alone = side;
    const { a, b } = difference.witness;
    const plain: Sides<FaceClass[]> = { a: [], b: [] };
    this.#models.classify({ ...plain, [side]: only(difference.face, classOf(kind)) });
    const [from, to] = side === "a" ? [a.point, b.point] : [b.point, a.point];
    const { lower, upper } = difference;
    const texts = { length: attainedText([lower, upper], diff.diagonal), from: "", to: "" };
    this.#arrow.show(from, to, texts, this.#models.center);
    return this.#around(side, difference.face, [from, to]);
  }

  #around(side: Side, face: number, points: readonly Point[]): Around {
    const box = this.#models.faceBox(side, face);
    for (const point of points) box.expandByPoint(new Vector3(...point).sub(this.#models.center));
    return { center: box.getCenter(new Vector3()), size: box.getSize(new Vector3()).length() };
  }
}

/** The classes of a model of whose faces only one has a class of its own. */
function only(face: number, own: FaceClass): FaceClass[] {
  const classes: FaceClass[] = [];
  classes[face] = own;
  return classes;
}
