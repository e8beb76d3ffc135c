// The tasks about bodies: their facts, the volume that both models have in common, and the check of all
// pairs of bodies.
import type { Transform } from "nurbs-hausdorff";
import type { Hausdorff, NurbsModel } from "nurbs-hausdorff/worker";
import { Latest } from "./latest.ts";
import { placedModel } from "./models/placed.ts";
import {
  type CheckedFaces,
  type CheckOf,
  type CheckState,
  type FactsState,
  type ModelFacts,
  type OverlapState,
  type PlainCheckOptions,
  type PlainOverlapOptions,
  type Reply,
  SIDES,
  type Sides,
  type Source,
} from "./protocol.ts";

export class BodyTasks {
  readonly #engine: Hausdorff;
  readonly #facts: Latest<FactsState>;
  readonly #overlap: Latest<OverlapState>;
  readonly #check: Latest<CheckState>;
  #sources: Sides<Source> = {};

  constructor(engine: Hausdorff, reply: (reply: Reply) => void) {
    this.#engine = engine;
    this.#facts = new Latest((state) => reply({ kind: "facts", ...state }));
    this.#overlap = new Latest((state) => reply({ kind: "overlap", ...state }));
    this.#check = new Latest((state) => reply({ kind: "check", ...state }));
  }

  /** States the facts of the models that there are, and of their bodies. */
  facts(models: Sides<NurbsModel>): Promise<void> {
    return this.#facts.run(async () => {
      const found: Sides<ModelFacts> = {};
      for (const side of SIDES) {
        const model = models[side];
        if (model === undefined) continue;
        found[side] = { facts: await model.facts(), bodies: await model.bodies() };
      }
      return { state: "done", models: found };
    });
  }

  /** Bounds the volumes that both models have in common and apart. */
  overlap(a: NurbsModel, b: NurbsModel, options: PlainOverlapOptions): Promise<void> {
    return this.#overlap.run(async (signal, report) => {
      report({ state: "working", fraction: 0 });
      const onProgress = (fraction: number) => report({ state: "working", fraction });
      const result = await this.#engine.overlap(a, b, { ...options, signal, onProgress });
      return { state: "done", result };
    });
  }

  cancelOverlap(): void {
    this.#overlap.cancel();
  }

  /** Notes what models were read from. */
  replaced(sources: Sides<Source>): void {
    this.#sources = { ...this.#sources, ...sources };
  }

  /** The faces of each body of the models that there are. */
  async bodies(models: Sides<NurbsModel>): Promise<Sides<number[][]>> {
    const found: Sides<number[][]> = {};
    for (const side of SIDES) {
      const bodies = await models[side]?.bodies();
      if (bodies !== undefined) found[side] = bodies.map(({ faces }) => faces);
    }
    return found;
  }

  /** Checks all pairs of bodies of one model, or of both as one assembly, A where it was moved to. */
  check(
    models: Sides<NurbsModel>,
    of: CheckOf,
    { options, transform }: { options: PlainCheckOptions; transform: Transform | undefined },
  ): Promise<void> {
    const sides = of === "both" ? SIDES : [of];
    return this.#check.run(async (signal, report) => {
      report({ state: "working", fraction: 0 });
      const onProgress = (fraction: number) => report({ state: "working", fraction });
      const { a } = this.#sources;
      const placed =
        transform === undefined || a === undefined
          ? undefined
          : await placedModel(this.#engine, a, transform);
      const all: Sides<NurbsModel> = placed === undefined ? models : { ...models, a: placed };
      try {
        const checked = sides.flatMap((side) => all[side] ?? []);
        const names = sides.map((side) => side.toUpperCase());
        const result = await this.#engine.check(checked, {
          ...{ ...options, signal, onProgress },
          ...(checked.length > 1 && { names }),
        });
        const bodies: CheckedFaces[] = [];
        for (const side of sides) {
          for (const { faces } of (await all[side]?.bodies()) ?? []) bodies.push({ side, faces });
        }
        return { state: "done", of, result, bodies };
      } finally {
        placed?.dispose();
      }
    });
  }

  cancelCheck(): void {
    this.#check.cancel();
  }

  /** Ends all tasks because their models are replaced. */
  drop(): void {
    this.#facts.drop();
    this.#overlap.drop();
    this.#check.drop();
  }
}
