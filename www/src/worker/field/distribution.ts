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
  const count = fields.reduce((sum, field) => sum + field.areas.length, 0);
  const [values, areas] = [new Float64Array(count), new Float64Array(count)];
  let first = 0;
  for (const field of fields) {
    values.set(valuesOf(field), first);
    areas.set(field.areas, first);
    first += field.areas.length;
  }
  const order = Uint32Array.from(values.keys()).filter(
    (index) => !Number.isNaN(values[index] ?? Number.NaN),
  );
  order.sort((one, other) => (values[one] ?? 0) - (values[other] ?? 0));
  let area = 0;
  return {
    values: Float64Array.from(order, (index) => values[index] ?? 0),
    areas: Float64Array.from(order, (index) => {
      area += areas[index] ?? 0;
      return area;
    }),
  };
}
