import type { FacetArrays } from "./facet-tessellation.js";

/**
 * A model as another worker makes an equal one of: interchange JSON, or the arrays of a mesh or a cloud.
 * @internal
 */
export type ModelSource =
  | { json: string }
  | { facets: FacetArrays; unit: number | undefined; gap: number };
