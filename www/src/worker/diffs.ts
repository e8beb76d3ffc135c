// The comparison face by face where faces have limits of their own.
import type {
  DiffOptions,
  DiffResult,
  FaceState,
  Hausdorff,
  NurbsModel,
} from "nurbs-hausdorff/worker";
import type { PlacedPart, PlainDiffOptions } from "./protocol.ts";

interface Pair {
  a: NurbsModel;
  b: NurbsModel;
}

/** Compares once for each of the limits, and takes every face from the comparison by its own. */
export async function diffByLimits(
  engine: Hausdorff,
  { a, b }: Pair,
  { own = [], ...options }: PlainDiffOptions & Pick<DiffOptions, "signal" | "onProgress">,
): Promise<DiffResult> {
  const limits = [...new Set(own.map(({ limit }) => limit))];
  const part = (index: number): DiffOptions => ({
    ...options,
    onProgress: (fraction) => options.onProgress?.((index + fraction) / (limits.length + 1)),
  });
  const result = await engine.diff(a, b, part(0));
  for (const [index, limit] of limits.entries()) {
    const other = await engine.diff(a, b, { ...part(index + 1), limit });
    result.seconds.solve += other.seconds.solve;
    for (const { side, face } of own.filter((one) => one.limit === limit)) {
      const [to, from] =
        side === "a" ? [result.facesOfA, other.facesOfA] : [result.facesOfB, other.facesOfB];
      const difference = from[face];
      if (difference !== undefined && face in to) to[face] = difference;
    }
  }
  const faces = [...result.facesOfA, ...result.facesOfB];
  return {
    ...result,
    state: together(faces.map(({ state }) => state)),
    withGaps: together(faces.map(({ withGaps }) => withGaps)),
  };
}

/** Returns what became of each part, with its faces; none where there is but one part. */
export async function placedParts({ parts }: DiffResult, { a, b }: Pair): Promise<PlacedPart[]> {
  if (parts.length < 2) return [];
  const [ofA, ofB] = [await facesByName(a), await facesByName(b)];
  return parts.map((part) => ({
    ...part,
    facesOf: { a: ofA.get(part.nameOfA ?? "") ?? [], b: ofB.get(part.nameOfB ?? "") ?? [] },
  }));
}

async function facesByName(model: NurbsModel): Promise<Map<string, number[]>> {
  const bodies = await model.bodies();
  return new Map(bodies.map(({ fullName, faces }) => [fullName, faces]));
}

/** `changed` if a face is, else `undecided` if one is. */
const together = (states: readonly FaceState[]): FaceState =>
  (["changed", "undecided"] as const).find((state) => states.includes(state)) ?? "unchanged";
