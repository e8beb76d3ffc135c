/// <reference lib="esnext.disposable" preserve="true" />
import type { CadReport } from "../cad/report.js";
import { HausdorffError } from "../error.js";
import type { Vector3 } from "../measure/options.js";
import type { ModelArea } from "../model/area.js";
import type { Body, Facts } from "../model/facts.js";
import type { FaceForm } from "../model/form.js";
import type { UpdateOptions } from "../model/model.js";
import type { Solid } from "../model/solid.js";
import type { Numbers } from "../model/surface.js";
import type { Tessellation, TessellationOptions } from "../model/tessellation.js";
import type { Channel } from "./channel.js";
import type { ModelFacts } from "./messages.js";

/** Drops the worker's model when its twin is garbage. */
const abandoned = new FinalizationRegistry<{ channel: Channel; id: number }>(({ channel, id }) =>
  channel.drop(id),
);

/**
 * A model in the worker; made by `Hausdorff.model` and `Hausdorff.shape` of this
 * entry, and tied to the worker that made it. Dispose of it when done.
 */
export class NurbsModel {
  readonly #channel: Channel;
  readonly #id: number;
  #facts: ModelFacts;
  #disposed = false;

  /** The report of the reader that made the model from a CAD file; null for other models. */
  readonly report: CadReport | null;

  private constructor(channel: Channel, id: number, facts: ModelFacts) {
    this.#channel = channel;
    this.#id = id;
    this.#facts = facts;
    this.report = facts.report;
    abandoned.register(this, { channel, id }, this);
  }

  /** @internal */
  static of(channel: Channel, id: number, facts: ModelFacts): NurbsModel {
    return new NurbsModel(channel, id, facts);
  }

  /**
   * The number of a model of this channel.
   * @internal
   */
  static id(model: unknown, channel: Channel, name: string): number {
    if (!(model instanceof NurbsModel)) {
      throw new HausdorffError("ARGUMENT_INVALID", `${name} is not a NurbsModel of a worker`);
    }
    if (model.#disposed) throw new HausdorffError("DISPOSED", "the model was disposed of");
    if (model.#channel !== channel) {
      throw new HausdorffError("ARGUMENT_INVALID", `${name} is a model of another worker`);
    }
    return model.#id;
  }

  /** The name in the model's JSON, or the shape's. */
  get name(): string | null {
    return this.#facts.name;
  }

  /** Metres per model unit, or null if the model does not state it. */
  get unit(): number | null {
    return this.#facts.unit;
  }

  /** The model's distance from its source, in model units, as its reader states it. */
  get gap(): number {
    return this.#facts.gap;
  }

  /** Whether the gap is an upper bound, as far as the reader knows, and not measured at points. */
  get gapProven(): boolean {
    return this.#facts.gapProven;
  }

  /** The name of a face in its source, or null; `facePath` splits it into the levels of an assembly. */
  faceName(face: number): string | null {
    return this.#facts.faceNames[face] ?? null;
  }

  /**
   * The colour of a face in its source, as red, green and blue of sRGB from 0 to 1: its own, else that
   * of the body that it belongs to; null where the source gives it none.
   */
  faceColor(face: number): Vector3 | null {
    return this.#facts.faceColors[face] ?? null;
  }

  /** Number of faces, at least 1. */
  get faceCount(): number {
    return this.#facts.faceCount;
  }

  /** The box of all control points, which contains the model. */
  get boundingBox(): { min: Vector3; max: Vector3 } {
    return this.#facts.boundingBox;
  }

  /** As the plain model's, in the worker. */
  async area(): Promise<ModelArea> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("area", [id]);
    return result as ModelArea;
  }

  /** As the plain model's, in the worker. */
  async solid(): Promise<Solid> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("solid", [id]);
    return result as Solid;
  }

  /** As the plain model's, in the worker. */
  async faceForms(): Promise<(FaceForm | null)[]> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("faceForms", [id]);
    return result as (FaceForm | null)[];
  }

  /** As the plain model's, in the worker. */
  async facts(): Promise<Facts> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("facts", [id]);
    return result as Facts;
  }

  /** As the plain model's, in the worker. */
  async bodies(): Promise<Body[]> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("bodies", [id]);
    return result as Body[];
  }

  /** As the plain model's, in the worker. */
  async tessellate(options: TessellationOptions = {}): Promise<Tessellation> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [result] = await this.#channel.call("tessellate", [id, options]);
    return result as Tessellation;
  }

  /** As the plain model's; what is called afterwards uses the new control points. */
  async update(face: number, points: Numbers, options: UpdateOptions = {}): Promise<void> {
    const id = NurbsModel.id(this, this.#channel, "the model");
    const [facts] = await this.#channel.call("update", [id, face, points, options]);
    this.#facts = facts as ModelFacts;
  }

  /** Frees its memory in the worker; distances that use it still end well. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    abandoned.unregister(this);
    this.#channel.drop(this.#id);
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
