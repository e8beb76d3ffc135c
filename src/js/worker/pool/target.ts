import type { NurbsModel } from "../../model/model.js";
import type { ModelSource } from "../../model/source.js";

/**
 * A model that points are measured from, held while they are, under the number by which the first worker knows it.
 * @internal
 */
export class Target {
  readonly id: number;
  readonly model: NurbsModel;
  #source: { made: ModelSource | undefined } | undefined;

  constructor(id: number, model: NurbsModel) {
    this.id = id;
    this.model = model.held();
  }

  /** What other workers make it of, made once for all; undefined if they cannot. */
  get source(): ModelSource | undefined {
    this.#source ??= { made: this.model.source };
    return this.#source.made;
  }

  dispose(): void {
    this.model.dispose();
  }
}
