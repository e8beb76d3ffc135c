// The distribution of the deviation over the area of the samples: estimates.
import type { FaceDeviations } from "nurbs-hausdorff";

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

/** O(n log n) in the number of samples, which are sorted once: |signed| is the distance. */
export function distributionOf(fields: FaceDeviations[]): Distribution {
  const distances = joined(fields, ({ distances }) => distances);
  const signed = joined(fields, ({ signed }) => signed);
  const areas = joined(fields, ({ areas }) => areas);
  const order = Uint32Array.from(distances.keys());
  order.sort((one, other) => (distances[one] ?? 0) - (distances[other] ?? 0));
  // A sample without a sign has NaN, which is neither.
  const negative = order.filter((sample) => (signed[sample] ?? 0) < 0).reverse();
  const positive = order.filter((sample) => (signed[sample] ?? 0) >= 0);
  const bySign = new Uint32Array(negative.length + positive.length);
  bySign.set(negative);
  bySign.set(positive, negative.length);
  return {
    absolute: cumulative(distances, areas, order),
    signed: cumulative(signed, areas, bySign),
  };
}

function joined(
  fields: FaceDeviations[],
  valuesOf: (field: FaceDeviations) => Float64Array,
): Float64Array {
  const all = new Float64Array(fields.reduce((sum, { areas }) => sum + areas.length, 0));
  let first = 0;
  for (const field of fields) {
    all.set(valuesOf(field), first);
    first += field.areas.length;
  }
  return all;
}

function cumulative(values: Float64Array, areas: Float64Array, order: Uint32Array): Cumulative {
  const [sorted, upTo] = [new Float64Array(order.length), new Float64Array(order.length)];
  let area = 0;
  for (const [place, sample] of order.entries()) {
    area += areas[sample] ?? 0;
    sorted[place] = values[sample] ?? 0;
    upTo[place] = area;
  }
  return { values: sorted, areas: upTo };
}
