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
  readonly #found: Omit<ClosestPoints, "signs" | "decidedOnGpu">;
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
      ...{ feet: floats(feet), faces: new Uint32Array(faces * this.#order.length) },
      parameters: floats(parameters),
    };
  }

  take(): PointBlock | undefined {
    const indices = this.#order.subarray(this.#taken, this.#taken + pointsOfBlock());
    if (indices.length === 0) return undefined;
    this.#taken += indices.length;
    const points = new Float64Array(3 * indices.length);
    copy({ from: this.#points, to: points, width: 3 }, indices, "gather");
    return { indices, points };
  }

  put({ indices }: PointBlock, found: ClosestPoints): void {
    this.#signs = found.signs;
    for (const name of Object.keys(WIDTHS) as (keyof typeof WIDTHS)[]) {
      const [from, to, width] = [found[name], this.#found[name], WIDTHS[name]];
      copy({ from, to, width }, indices, "scatter");
    }
    this.#done += indices.length;
  }

  get fraction(): number {
    return this.#order.length === 0 ? 1 : this.#done / this.#order.length;
  }

  get found(): ClosestPoints {
    // Blocks are measured on the CPU.
    return { ...this.#found, signs: this.#signs, decidedOnGpu: 0 };
  }
}

type Numbers = Float64Array | Uint32Array;

/** Copies the numbers of each point from its index to its place among these, or back. */
function copy(
  { from, to, width }: { from: Numbers; to: Numbers; width: number },
  indices: Uint32Array,
  way: "gather" | "scatter",
): void {
  for (let place = 0; place < indices.length; place++) {
    const index = indices[place] ?? 0;
    const [source, target] = way === "gather" ? [index, place] : [place, index];
    for (let k = 0; k < width; k++) to[width * target + k] = from[width * source + k] ?? 0;
  }
}
