import type { NurbsModel } from "../../model/model.js";
import type { ModelSource } from "../../model/source.js";

/**
 * A model that points are measured from, held while they are, under the number by which the first worker knows it.
 * @internal
 */
export class Target {
  readonly id: number;
  readonly model: NurbsModel;
  /** The milliseconds that the model took to be made. */
  readonly milliseconds: number;
  #source: { made: ModelSource | undefined } | undefined;

  constructor(id: number, model: NurbsModel, milliseconds: number) {
    this.id = id;
    this.model = model.held();
    this.milliseconds = milliseconds;
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
