import { translating } from "../../error.js";
import type { ClosestPoints } from "../../measure/points/closest.js";
import { measuringOrder, pointsOfBlock } from "../../wasm/nurbs_hausdorff.js";
import type { Shared } from "./work.js";

/** Consecutive points in the order in which they are measured. */
export interface PointBlock {
  /** Their indices among all points. */
  indices: Uint32Array;
  /** x, y, z each. */
  points: Float64Array<ArrayBuffer>;
}

/** The numbers of each point in the arrays of closest points. */
const WIDTHS = { distances: 1, bounds: 1, signed: 1, feet: 3, faces: 1, parameters: 2 } as const;

/**
 * Points shared out in blocks, with what was found of them.
 * @internal
 */
export class PointBlocks implements Shared<PointBlock, ClosestPoints, ClosestPoints> {
  readonly #points: Float64Array;
  readonly #order: Uint32Array;
  readonly #found: Omit<ClosestPoints, "signs">;
  #signs: ClosestPoints["signs"] = "faces";
  #taken = 0;
  #done = 0;

  /** @throws {HausdorffError} `POINT_OUT_OF_RANGE`, with the index of the point. */
  constructor(points: Float64Array) {
    this.#points = points;
    this.#order = translating(() => measuringOrder(points));
    const floats = (width: number) => new Float64Array(width * this.#order.length);
    const { distances, bounds, signed, feet, faces, parameters } = WIDTHS;
    this.#found = {
      ...{ distances: floats(distances), bounds: floats(bounds), signed: floats(signed) },
      ...{ feet: floats(feet), parameters: floats(parameters) },
      faces: new Uint32Array(faces * this.#order.length),
    };
  }

  take(): PointBlock | undefined {
    const indices = this.#order.subarray(this.#taken, this.#taken + pointsOfBlock());
    if (indices.length === 0) return undefined;
    this.#taken += indices.length;
    const points = new Float64Array(3 * indices.length);
    for (const [place, index] of indices.entries()) {
      points.set(this.#points.subarray(3 * index, 3 * index + 3), 3 * place);
    }
    return { indices, points };
  }

  put({ indices }: PointBlock, found: ClosestPoints): void {
    this.#signs = found.signs;
    for (const name of Object.keys(WIDTHS) as (keyof typeof WIDTHS)[]) {
      const [to, from, width] = [this.#found[name], found[name], WIDTHS[name]];
      for (const [place, index] of indices.entries()) {
        for (let k = 0; k < width; k++) to[width * index + k] = from[width * place + k] ?? 0;
      }
    }
    this.#done += indices.length;
  }

  get fraction(): number {
    return this.#order.length === 0 ? 1 : this.#done / this.#order.length;
  }

  get found(): ClosestPoints {
    return { ...this.#found, signs: this.#signs };
  }
}
