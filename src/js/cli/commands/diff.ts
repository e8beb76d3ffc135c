import type { DiffOptions, DiffResult, FaceDifference, FaceState } from "../../measure/diff.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { isJudged } from "../files.js";
import { ofFiles } from "../output/json.js";
import { full } from "../output/numbers.js";
import { Progress } from "../output/progress.js";
import { GAPS_DECIDE } from "../output/report.js";
import { comparePairs } from "../pairs/pairs.js";
import type { Verdict } from "../reports/answer.js";
import type { Shown, ShownModel } from "../reports/figures.js";
import { libraryOptions } from "./library-options.js";

/** The largest number of faces of one model and state that the table lists; JSON has all. */
const MAX_LISTED = 100;

const VERDICTS: Readonly<Record<FaceState, Verdict>> = {
  unchanged: "passed",
  changed: "failed",
  undecided: "undecided",
};

/** Compares the models face by face, prints the differences and returns the exit status. */
export async function diff(values: Invocation["values"]): Promise<number> {
  using hd = await Hausdorff.create({ backend: "cpu" });
  const options: DiffOptions = libraryOptions(values);
  const [allowsSkipped, isStrict] = [values.has("allow-skipped"), values.has("strict-gaps")];
  return await comparePairs(values, {
    command: "diff",
    options: { ...options, allowsSkipped, isStrict },
    compare: async (a, b) => {
      const progress = new Progress();
      const onProgress = progress.report;
      const result = await hd
        .diff(a.model, b.model, { ...options, onProgress })
        .finally(() => progress.end());
      const state = isJudged(a, b, allowsSkipped) ? result.state : "undecided";
      const withGaps = state === result.state ? result.withGaps : state;
      const shown = { ...result, state, withGaps };
      const word = isStrict ? withGaps : state;
      const isTimed = options.maxSeconds !== undefined && result.state === "undecided";
      const answer = {
        verdict: VERDICTS[word],
        limit: shown.limit,
        word,
        summary: summary(shown),
        findings: findings(shown),
        text: text(shown),
        seconds: result.seconds.prepare + result.seconds.solve,
        repeatable: !isTimed,
        json: ofFiles(shown, a, b),
      };
      return { answer, shown: picturesOf(result, options) };
    },
  });
}

/** Both models, with the farthest points of their faces. */
function picturesOf(result: DiffResult, { transform }: DiffOptions): Shown {
  const side = (
    faces: FaceDifference[],
    [from, to]: readonly ["a" | "b", "a" | "b"],
  ): ShownModel => {
    const inOrder = [...faces].sort((one, other) => one.face - other.face);
    // Of equal ones the last, as the native command takes.
    const largest = inOrder.reduce<FaceDifference | undefined>(
      (one, other) => (one !== undefined && one.lower > other.lower ? one : other),
      undefined,
    );
    const point = largest?.witness[from].point;
    const foot = largest?.witness[to].point;
    const known = largest !== undefined && point !== undefined && foot !== undefined;
    return {
      uppers: inOrder.map(({ upper }) => upper),
      farthest: known ? { face: largest.face, point, foot } : undefined,
    };
  };
  return {
    ...{ allowed: result.limit, transform },
    ...{ a: side(result.facesOfA, ["a", "b"]), b: side(result.facesOfB, ["b", "a"]) },
  };
}

/** Ends a line with a verdict that does not hold for every reading of the files. */
const doubt = ({ state, withGaps }: DiffResult): string => (withGaps === state ? "" : GAPS_DECIDE);

/** The numbers of faces in each state. */
function counts(faces: FaceDifference[]): string {
  return (["unchanged", "changed", "undecided"] as const)
    .map((state) => `${faces.filter((face) => face.state === state).length} ${state}`)
    .join(", ");
}

function summary(result: DiffResult): string {
  const [a, b] = [result.facesOfA, result.facesOfB].map(counts);
  return `faces of A: ${a}; of B: ${b}; limit ${full(result.limit)}${doubt(result)}`;
}

/** A line for each face that is not unchanged, those that changed first. */
function findings({ facesOfA, facesOfB }: DiffResult): string[] {
  const models = [
    ["A", facesOfA, "a"],
    ["B", facesOfB, "b"],
  ] as const;
  return (["changed", "undecided"] as const).flatMap((state) =>
    models.flatMap(([name, faces, side]) => {
      const listed = largestFirst(faces.filter((face) => face.state === state));
      const lines = listed.slice(0, MAX_LISTED).map(({ face, lower, upper, witness }) => {
        const { point, faceName } = witness[side];
        const named = faceName ? ` (${faceName})` : "";
        const interval = `[${full(lower)}, ${full(upper)}]`;
        return `${name} face ${face}${named} ${state}: ${interval} at ${point.map(full).join(" ")}`;
      });
      const more = listed.length - MAX_LISTED;
      return more > 0 ? [...lines, `and ${more} more faces of ${name} ${state}`] : lines;
    }),
  );
}

function text(result: DiffResult): string {
  const { prepare, solve } = result.seconds;
  const lines = [
    `models     ${result.state} at a limit of ${full(result.limit)}${doubt(result)}`,
    `faces of A ${counts(result.facesOfA)}`,
    `faces of B ${counts(result.facesOfB)}`,
    ...findings(result),
    `seconds    ${prepare.toFixed(3)} prepare, ${solve.toFixed(3)} solve`,
  ];
  return `${lines.join("\n")}\n`;
}

function largestFirst(faces: FaceDifference[]): FaceDifference[] {
  return faces.sort((one, other) => other.lower - one.lower);
}
