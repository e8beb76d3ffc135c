// The distribution of the deviation over the area of the samples: estimates.
import type { Field } from "nurbs-hausdorff";

/** Deviations in ascending order, each with the area up to it. */
export interface Cumulative {
  values: Float64Array<ArrayBuffer>;
  areas: Float64Array<ArrayBuffer>;
}

export interface Distribution {
  /** The distances. */
  absolute: Cumulative;
  /** The signed deviations of the samples that have a sign. */
  signed: Cumulative;
}

/** O(n log n) in the number of samples. */
export function distributionOf(fields: Field[]): Distribution {
  return {
    absolute: cumulative(fields, ({ distances }) => distances),
    signed: cumulative(fields, ({ signed }) => signed),
  };
}

function cumulative(fields: Field[], valuesOf: (field: Field) => Float64Array): Cumulative {
  const all = fields.flatMap((field) => {
    const values = valuesOf(field);
    return Array.from(values, (value, index) => [value, field.areas[index] ?? 0] as const);
  });
  const sorted = all
    .filter(([value]) => !Number.isNaN(value))
    .sort(([one], [other]) => one - other);
  let area = 0;
  return {
    values: Float64Array.from(sorted, ([value]) => value),
    areas: Float64Array.from(sorted, ([, own]) => {
      area += own;
      return area;
    }),
  };
}
