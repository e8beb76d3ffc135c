/// <reference lib="esnext.disposable" preserve="true" />
import type { CadReport } from "../cad/report.js";
import { HausdorffError, translating } from "../error.js";
import { checkKeys } from "../keys.js";
import type { Vector3 } from "../measure/options.js";
import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import type { ModelArea } from "./area.js";
import { type FacetArrays, facetTessellation } from "./facet-tessellation.js";
import type { Body, Facts } from "./facts.js";
import type { FaceForm } from "./form.js";
import type { Solid } from "./solid.js";
import type { ModelSource } from "./source.js";
import { controlPoints, type Numbers } from "./surface.js";
import type { Tessellation, TessellationOptions } from "./tessellation.js";

/** Options of `NurbsModel.update`. */
export interface UpdateOptions {
  /** Whether x, y, z are given multiplied by w; default no. */
  homogeneous?: boolean;
}

/** The largest index that the module's 32 bits take. */
const MAX_FACE = 2 ** 32 - 1;

/**
 * One or more NURBS surfaces, measured as one set of points; made by
 * `Hausdorff.model`, `Hausdorff.shape` and `readCad`.
 *
 * It holds memory outside of JavaScript's: dispose of it, or declare it with
 * `using`, when done. Else that memory is freed some time after the object.
 */
export class NurbsModel {
  #prepared: PreparedModel | undefined;

  /** What reading its file kept, approximated and left out; null for models of arrays and shapes. */
  readonly report: CadReport | null;

  /** The arrays of a mesh or a cloud of points, which displays them. */
  readonly #facets: FacetArrays | undefined;

  /** Whether control points were changed, after which cuts and trees are those of an older shape. */
  #isUpdated = false;

  private constructor(
    prepared: PreparedModel,
    report: CadReport | null,
    facets: FacetArrays | undefined,
  ) {
    this.#prepared = prepared;
    this.report = report;
    this.#facets = facets;
  }

  /** @internal */
  static of(
    prepared: PreparedModel,
    report: CadReport | null = null,
    facets?: FacetArrays,
  ): NurbsModel {
    return new NurbsModel(prepared, report, facets);
  }

  /**
   * The module's model.
   * @internal
   */
  get prepared(): PreparedModel {
    if (this.#prepared === undefined) {
      throw new HausdorffError("DISPOSED", "the model was disposed of");
    }
    return this.#prepared;
  }

  /**
   * What another worker makes an equal model of, which gives the same results bit for bit; undefined after
   * updates, and of a model whose text would be too long.
   * @internal
   */
  get source(): ModelSource | undefined {
    if (this.#isUpdated) return undefined;
    const { unit, gap } = this.prepared;
    if (this.#facets !== undefined) return { facets: this.#facets, unit, gap };
    const json = translating(() => this.prepared.toJson());
    return json === undefined ? undefined : { json };
  }

  /**
   * The model of a source.
   * @internal
   */
  static fromSource(source: ModelSource): NurbsModel {
    return translating(() => {
      if ("json" in source) return NurbsModel.of(PreparedModel.fromJson(source.json));
      const { facets, unit, gap } = source;
      const { positions, triangles, counts } = facets;
      const of = [positions, triangles, unit, counts, undefined, gap] as const;
      return NurbsModel.of(PreparedModel.fromFacets(...of), null, facets);
    });
  }

  /**
   * The model as it is now, which neither an update nor a disposal of this one changes.
   * @internal
   */
  held(): NurbsModel {
    const held = NurbsModel.of(this.prepared.held(), null, this.#facets);
    held.#isUpdated = this.#isUpdated;
    return held;
  }

  /** The name in the model's JSON, or the shape's. */
  get name(): string | null {
    return this.prepared.name ?? null;
  }

  /** Metres per model unit, or null if the model does not state it. */
  get unit(): number | null {
    return this.prepared.unit ?? null;
  }

  /** The model's distance from its source, in model units, as its reader states it. */
  get gap(): number {
    return this.prepared.gap;
  }

  /** Whether the gap is an upper bound, as far as the reader knows, and not measured at points. */
  get gapProven(): boolean {
    return this.prepared.gapProven;
  }

  /** The name of a face in its source, or null; `facePath` splits it into the levels of an assembly. */
  faceName(face: number): string | null {
    return this.prepared.faceName(face) ?? null;
  }

  /**
   * The colour of a face in its source, as red, green and blue of sRGB from 0 to 1: its own, else that
   * of the body that it belongs to; null where the source gives it none.
   */
  faceColor(face: number): Vector3 | null {
    const [red, green, blue] = this.prepared.faceColor(face);
    return red === undefined || green === undefined || blue === undefined
      ? null
      : [red, green, blue];
  }

  /** Number of faces, trimmed or whole, at least 1; with instances, of those they place. */
  get faceCount(): number {
    return this.prepared.faceCount;
  }

  /** The box of all control points of what is measured, which contains the model. */
  get boundingBox(): { min: Vector3; max: Vector3 } {
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = this.prepared.boundingBox;
    return { min: [a, b, c], max: [d, e, f] };
  }

  /**
   * The area of the model and of each of its faces, in squares of the model unit, as
   * intervals of about 1e-6 of the area: a face that is missing shows. Computed at the first
   * call, in about 0.1 ms a Bézier patch.
   */
  area(): ModelArea {
    const prepared = this.prepared;
    return translating(() => prepared.area() as ModelArea);
  }

  /**
   * Whether the faces close within their gaps, so that the model is a solid, with its shells; and
   * the free edges where they do not. Computed at the first call.
   */
  solid(): Solid {
    const prepared = this.prepared;
    return translating(() => prepared.solid() as Solid);
  }

  /**
   * For each face the plane, sphere, cylinder, cone or torus that it lies on, with bounds on how far its points
   * are from it; null for other surfaces. Of a mesh or a cloud there are none.
   */
  faceForms(): (FaceForm | null)[] {
    const prepared = this.prepared;
    return translating(() => prepared.faceForms() as (FaceForm | null)[]);
  }

  /**
   * Volume, area, extents, centroid and inertia, each an interval that contains it. Computed at the
   * first call.
   */
  facts(): Facts {
    const prepared = this.prepared;
    return translating(() => prepared.facts() as Facts);
  }

  /** The bodies, each with its facts: solids with their voids, sheets, or a cloud of points. */
  bodies(): Body[] {
    const prepared = this.prepared;
    return translating(() => prepared.bodies() as Body[]);
  }

  /**
   * Triangles that deviate from the model by at most the options' tolerance, provided
   * that about a million of them suffice.
   *
   * Those of a mesh are its own, whatever the options are; a cloud of points has vertices only.
   *
   * @throws {HausdorffError} `OPTION_OUT_OF_RANGE` unless the tolerance is
   * positive and finite; `OPTION_INVALID`.
   */
  tessellate(options: TessellationOptions = {}): Tessellation {
    const prepared = this.prepared;
    if (this.#facets !== undefined) return facetTessellation(this.#facets);
    return translating(() => prepared.tessellate(options) as Tessellation);
  }

  /**
   * Gives a face's surface other control points, as many as it has, on the same knots: a
   * deforming surface, frame after frame. Faster than a new model, as its cuts and
   * trees are kept. Distances that are being computed still measure the old surface.
   *
   * @param face its index
   * @param points x, y, z, w each, v fastest; with `homogeneous`, x, y, z multiplied by w
   * @throws {HausdorffError} as `Hausdorff.model`; `OPTION_OUT_OF_RANGE` for an index
   * that the model does not have. The model is then unchanged.
   */
  update(face: number, points: Numbers, options: UpdateOptions = {}): void {
    const prepared = this.prepared;
    checkKeys("options", options, ["homogeneous"]);
    if (!Number.isInteger(face) || face < 0 || face > MAX_FACE) {
      throw new HausdorffError("ARGUMENT_INVALID", `face is ${face}, expected an index`);
    }
    const changed = controlPoints(points, options.homogeneous, "");
    translating(() => prepared.update(face, changed));
    this.#isUpdated = true;
  }

  /** Frees its memory; distances that use it still end well. */
  dispose(): void {
    this.#prepared?.free();
    this.#prepared = undefined;
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
