import type { NurbsModel } from "../../worker/model.js";
import { type Input, type ModelReader, readModelBy } from "../files.js";

/** The models of one worker that were used last, by the paths of their files. */
export class Cache {
  readonly #reader: ModelReader<NurbsModel>;
  readonly #capacity: number;
  readonly #models = new Map<string, Promise<Input<NurbsModel>>>();

  constructor(reader: ModelReader<NurbsModel>, capacity: number) {
    this.#reader = reader;
    // A pair needs two.
    this.#capacity = Math.max(2, capacity);
  }

  /** The model of a file; a file that changes meanwhile is not read again. */
  async get(path: string): Promise<Input<NurbsModel>> {
    const model = this.#models.get(path) ?? readModelBy(this.#reader, path);
    // The first of a map is the one whose last use is longest ago.
    this.#models.delete(path);
    this.#models.set(path, model);
    const [oldest] = this.#models;
    if (this.#models.size > this.#capacity && oldest !== undefined) {
      this.#models.delete(oldest[0]);
      oldest[1].then(({ model }) => model.dispose()).catch(() => {});
    }
    return model;
  }
}
