import type { LayerDistances, SignedDistances } from "../../measure/points/signed-distances.js";
import type { Shared } from "./work.js";

/** A layer of a grid's bricks along z. */
export type Layer = number;

/**
 * The signed distances of a grid, shared out in layers of its bricks.
 * @internal
 */
export class Layers implements Shared<Layer, LayerDistances, SignedDistances> {
  readonly #parts: (LayerDistances | undefined)[];
  #taken = 0;
  #done = 0;

  constructor(count: number) {
    this.#parts = new Array(count).fill(undefined);
  }

  take(): Layer | undefined {
    if (this.#taken === this.#parts.length) return undefined;
    this.#taken += 1;
    return this.#taken - 1;
  }

  put(layer: Layer, part: LayerDistances): void {
    this.#parts[layer] = part;
    this.#done += 1;
  }

  get fraction(): number {
    return this.#done / this.#parts.length;
  }

  get found(): SignedDistances {
    const parts = this.#parts.filter((part) => part !== undefined);
    const [first] = parts as [LayerDistances, ...LayerDistances[]];
    const largest = (numbers: number[]) => Math.max(...numbers);
    const { rounding: _, ...rest } = first;
    return {
      ...rest,
      values: joined(parts.map(({ values }) => values)) as SignedDistances["values"],
      undecided: joined(parts.map(({ undecided }) => undecided)),
      bound: largest(parts.map(({ bound }) => bound)) + largest(parts.map((part) => part.rounding)),
      measured: parts.reduce((sum, { measured }) => sum + measured, 0),
    };
  }
}

type Numbers = Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

/** One array after the other. */
function joined<Array extends Numbers>(arrays: Array[]): Array {
  const [first] = arrays as [Array, ...Array[]];
  const length = arrays.reduce((sum, array) => sum + array.length, 0);
  const all = new (first.constructor as new (length: number) => Array)(length);
  let start = 0;
  for (const array of arrays) {
    all.set(array, start);
    start += array.length;
  }
  return all;
}
