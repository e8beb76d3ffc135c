import { HausdorffError } from "../../error.js";
import { checkKeys } from "../../keys.js";
import type { Interval, Orientation } from "../../model/facts.js";
import type { Vector3 } from "../options.js";
import type { OnProgress } from "../progress.js";

/** Patterns of the two names of a pair, in either order. */
export interface NamesOfPair {
  a: string;
  b: string;
}

/** What is meant, and what must be: the rules of a file that the command takes, as it is parsed. */
export interface CheckRules {
  /** Pairs whose clashes are meant, such as those of a thread; they are listed and not judged. */
  intended?: readonly NamesOfPair[];
  /** Each body whose name matches `a` must touch or clash with a body whose name matches `b`. */
  mustTouch?: readonly NamesOfPair[];
  /** Pairs that must be apart by a distance, in model units. */
  atLeast?: readonly (NamesOfPair & { distance: number })[];
}

/** Options of `Hausdorff.check`. */
export interface CheckOptions {
  /** The level above the names of the bodies of each model; of several, `model 1` by its number if not given. */
  names?: readonly string[];
  /** The distance, in model units, below which bodies are near; 0 if not given. */
  below?: number;
  /** The distance, in model units, up to which bodies touch; it is the permitted width of intervals, too. */
  tolerance?: number;
  /** The same as a fraction of the diagonal of all bodies; 1e-6 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /**
   * In a name, `*` is any text within a level, `?` any character, and a level `**` any number of levels. A pattern
   * of no body is an error.
   */
  rules?: CheckRules;
  /** Pairs of cells, for each pair of bodies, after which its interval so far is taken; 200,000 if not given. */
  maxCells?: number;
  /** Seconds after which pairs that are not searched yet are bounded once only. */
  maxSeconds?: number;
  /** Whether models are scaled to the unit of the first where they state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the part that is done. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/**
 * How two bodies lie to each other. `clash`: a point is certainly inside both. `touching`: they are certainly within
 * the tolerance. `near`: certainly nearer than `below`, without a common inside. `apart`: certainly at least `below`
 * apart. Else `undecided`.
 */
export type PairState = "clash" | "undecided" | "touching" | "near" | "apart";

/** Two bodies, and how they lie to each other. */
export interface BodyPair {
  /** Their names. */
  a: string;
  b: string;
  state: PairState;
  /** The least distance of their points is in it; 0 where they clash. */
  clearance: Interval;
  /** Of a clash, the volume of their common part is in it, if both have one. */
  volume: Interval | null;
  /** Of a clash, the length of the shortest motion without a turn that leaves them without a common inside. */
  depth: Interval | null;
  /** Of a clash, a point inside both; else the point of `a` that is nearest to `b`. */
  point: Vector3;
  /** Whether a rule says that what happens between them is meant. */
  intended: boolean;
  /** Why the state is not decided. */
  why?: string;
}

/** A body by itself. */
export interface CheckedBody {
  /** Its levels, joined as those of a face's name are; `facePath` splits them. */
  name: string;
  /** The index of the model that it is of. */
  model: number;
  kind: "solid" | "sheet";
  /** Whether every edge of its faces has a partner. */
  closed: boolean;
  orientation: Orientation | null;
  /** Whether it closes and certainly has no inside to speak of. */
  degenerate: boolean;
  /** Whether its boundary certainly meets itself nowhere, up to its gaps, or certainly does; null where neither is known. */
  embedded: boolean | null;
  /**
   * Of a body that is embedded, the length of the way along its boundary between points of it that are as near to each
   * other as its gaps, at most.
   */
  embeddedWithin: number | null;
  /** Why it is not known whether it is embedded. */
  embeddedUnknown: EmbeddedUnknown | null;
  /** A place at which its boundary meets itself; null unless it certainly does. */
  selfOverlap: SelfOverlap | null;
  /** The names of the bodies that certainly have its shape in its place, within the tolerance. */
  duplicates: string[];
}

/** What is not decided of a body's boundary. */
export interface EmbeddedUnknown {
  /**
   * `contact`: faces touch, cross, or come as near to each other as the gaps beside all edges and corners that they
   * share; `budget`: too many pairs of pieces, or too late; `refuted`: points contradicted what was proven of
   * them, a fault of the library; `gaps`: a mesh has gaps; `too-large`: a mesh has more than 250,000 triangles.
   */
  why: "contact" | "budget" | "refuted" | "gaps" | "too-large";
  /** The indices of two faces, or of one, of a pair that was not decided, in the body's model; none of a mesh. */
  faces: number[];
  /** A point about where it is, if it is at one. */
  point: Vector3 | null;
}

/**
 * A place at which the boundary of a body meets itself: it certainly winds about points of the ball and about others
 * near by with numbers that differ by 2 or more, and the gaps of the body are smaller than the ball.
 */
export interface SelfOverlap {
  /** The middle of the ball. */
  point: Vector3;
  /** The radius of the ball, which has no points of the boundary. */
  radius: number;
  /**
   * How often the boundary winds about it, 1 or 0 in a body that does not meet itself: 2 or more in matter that counts
   * twice, -1 or less where walls have passed through each other.
   */
  winding: number;
  /** The indices of the two faces that cross near by, in the body's model; none of a mesh. */
  faces: number[];
}

/** A rule that is not certainly kept. */
export interface UnkeptRule {
  rule: "mustTouch" | "atLeast";
  /** Whether it is certainly broken; else it is undecided. */
  broken: boolean;
  a: string;
  /** The other body; of `mustTouch`, the pattern of those that `a` may touch. */
  b: string;
  distance?: number;
  clearance?: Interval;
}

/** All pairs of bodies. Guarantee: as `PairState` states, and what is not listed is apart. */
export interface CheckResult {
  /**
   * Whether no pair clashes that is not intended to, and all rules are kept; null where that is not decided.
   * Faults of single bodies are no part of it.
   */
  clean: boolean | null;
  /** The pairs whose boxes are near, clashes first. */
  pairs: BodyPair[];
  /** The rules that are not certainly kept. */
  rules: UnkeptRule[];
  bodies: CheckedBody[];
  /** The number of all pairs. */
  pairCount: number;
  /** The distance below which bodies are near. */
  below: number;
  /** The distance up to which they touch, in model units. */
  tolerance: number;
  /** The diagonal of the box of all bodies. */
  diagonal: number;
  /** Metres per unit of length, if the first model states its unit. */
  unit?: number;
  seconds: { prepare: number; compile: number; solve: number };
}

/** The kinds of rules, with the names of one. */
const RULES: Record<keyof CheckRules, readonly string[]> = {
  intended: ["a", "b"],
  mustTouch: ["a", "b"],
  atLeast: ["a", "b", "distance"],
};

/**
 * Refuses names in rules that are not known: the module sees only those that it looks for.
 *
 * @throws {HausdorffError} `OPTION_INVALID`.
 * @internal
 */
export function checkRules(rules: CheckRules | undefined): void {
  if (typeof rules !== "object" || rules === null) return;
  checkKeys("rules", rules, Object.keys(RULES));
  for (const [name, known] of Object.entries(RULES)) {
    const given: unknown = rules[name as keyof CheckRules] ?? [];
    for (const rule of Array.isArray(given) ? given : [])
      checkKeys(`rules.${name}`, rule ?? {}, known);
  }
}

/**
 * The level above the names of the bodies of each model; none of one model.
 *
 * @throws {HausdorffError} `OPTION_INVALID` for another number of names than of models.
 * @internal
 */
export function levels(count: number, names: unknown): (string | undefined)[] {
  if (names === undefined) {
    const numbers = Array.from({ length: count }, (_, index) => index + 1);
    return numbers.map((number) => (count === 1 ? undefined : `model ${number}`));
  }
  if (!Array.isArray(names) || names.length !== count) {
    const found = Array.isArray(names) ? `${names.length} names` : typeof names;
    const message = `names: found ${found}, expected one of each of ${count} models`;
    throw new HausdorffError("OPTION_INVALID", message);
  }
  return names.map((name) => `${name}`);
}
