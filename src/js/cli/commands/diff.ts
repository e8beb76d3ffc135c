import type { DiffOptions, DiffResult, FaceDifference, FaceState } from "../../measure/diff.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { isJudged, readModel } from "../files.js";
import { ofFiles, printJson } from "../output/json.js";
import { full } from "../output/numbers.js";
import { print } from "../output/output.js";
import { Progress } from "../output/progress.js";
import { GAPS_DECIDE } from "../output/report.js";
import { libraryOptions } from "./library-options.js";

/** The largest number of faces of one model and state that the table lists; JSON has all. */
const MAX_LISTED = 100;

const STATUSES: Readonly<Record<FaceState, number>> = { unchanged: 0, changed: 1, undecided: 3 };

/** Compares the models face by face, prints the differences and returns the exit status. */
export async function diff(values: Invocation["values"]): Promise<number> {
  using hd = await Hausdorff.create({ backend: "cpu" });
  using a = await readModel(String(values.get("a")));
  using b = await readModel(String(values.get("b")));
  const progress = new Progress();
  const options: DiffOptions = { ...libraryOptions(values), onProgress: progress.report };
  const result = await hd.diff(a.model, b.model, options).finally(() => progress.end());
  const state = isJudged(a, b, values.has("allow-skipped")) ? result.state : "undecided";
  const withGaps = state === result.state ? result.withGaps : state;
  const shown = { ...result, state, withGaps };
  if (values.has("json")) printJson(ofFiles(shown, a, b));
  else print(text(shown));
  return STATUSES[values.has("strict-gaps") ? withGaps : state];
}

function text(result: DiffResult): string {
  const models = [
    ["A", result.facesOfA, "a"],
    ["B", result.facesOfB, "b"],
  ] as const;
  const doubt = result.withGaps === result.state ? "" : GAPS_DECIDE;
  const lines = [`models     ${result.state} at a limit of ${full(result.limit)}${doubt}`];
  for (const [name, faces] of models) {
    const [unchanged, changed, undecided] = (["unchanged", "changed", "undecided"] as const).map(
      (state) => faces.filter((face) => face.state === state).length,
    );
    lines.push(
      `faces of ${name} ${unchanged} unchanged, ${changed} changed, ${undecided} undecided`,
    );
  }
  for (const state of ["changed", "undecided"] as const) {
    for (const [name, faces, side] of models) {
      const listed = largestFirst(faces.filter((face) => face.state === state));
      lines.push(
        ...listed.slice(0, MAX_LISTED).map(({ face, lower, upper, witness }) => {
          const place = witness[side].point.map(full).join(" ");
          return `${state.padEnd(10)} ${name} face ${face}: [${full(lower)}, ${full(upper)}] at ${place}`;
        }),
      );
      const more = listed.length - MAX_LISTED;
      if (more > 0) lines.push(`           and ${more} more faces of ${name}`);
    }
  }
  const { prepare, solve } = result.seconds;
  lines.push(`seconds    ${prepare.toFixed(3)} prepare, ${solve.toFixed(3)} solve`);
  return `${lines.join("\n")}\n`;
}

function largestFirst(faces: FaceDifference[]): FaceDifference[] {
  return faces.sort((one, other) => other.lower - one.lower);
}
