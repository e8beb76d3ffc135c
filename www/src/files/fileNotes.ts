// Below each model, a line about its file: format, unit, faces, and everything
// that reading it left out or approximated, which unfolds to the details.
import type { CadReport, SkippedFace } from "nurbs-hausdorff/cad";
import { element } from "../common/elements.ts";
import { grouped, upperText } from "../common/text/numbers.ts";
import { unitName } from "../common/text/units.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { FORMATS } from "./formats.ts";

/** Skipped faces listed; more are counted. */
const MAX_SKIPPED = 50;

const notes: Record<Side, HTMLElement> = { a: element("note-a"), b: element("note-b") };
const skipped: Sides<number> = {};

/** Shows the notes of models that were loaded. */
export function showFileNotes(models: Sides<DisplayModel>): void {
  for (const side of SIDES) {
    const model = models[side];
    if (model === undefined) continue;
    const { report } = model;
    skipped[side] = report?.skipped.length ?? 0;
    const told = report === null || isSilent(report) ? undefined : note(report);
    const shown = model.isMesh ? [meshNote(model), told] : [told];
    const lines = shown.filter((line) => line !== undefined);
    notes[side].replaceChildren(...lines);
    notes[side].hidden = lines.length === 0;
  }
}

/** Returns how many faces of both files were skipped. */
export const skippedFaces = (): number => (skipped.a ?? 0) + (skipped.b ?? 0);

/** The line about a mesh or a cloud of points: how many triangles or points, and the unit; none for surfaces. */
function meshNote({ isMesh, tessellation, unit }: DisplayModel): HTMLElement | undefined {
  if (!isMesh) return undefined;
  const { indices, positions } = tessellation;
  const [count, what] =
    indices.length > 0 ? [indices.length / 3, "triangle"] : [positions.length / 3, "point"];
  const line = document.createElement("span");
  line.textContent = [
    indices.length > 0 ? "mesh" : "points",
    `${grouped(count)} ${what}${count === 1 ? "" : "s"}`,
    unit === null ? "unit unknown" : unitName(unit),
  ].join(" · ");
  return line;
}

/** Whether a report has nothing to say: that of a mesh which was read as a whole. */
const isSilent = ({ kind, skipped, notes }: CadReport): boolean =>
  kind === "mesh" && skipped.length === 0 && notes.length === 0;

function note(report: CadReport): HTMLElement {
  const { kind, reader, faces: read, unit, skipped, fitted } = report;
  const format = reader === "occt" ? `${FORMATS[kind]} by OpenCASCADE` : FORMATS[kind];
  const summary = document.createElement("summary");
  const faces = `${grouped(read)} ${read === 1 ? "face" : "faces"}`;
  summary.append([format, faces, unit === null ? "unit unknown" : unitName(unit)].join(" · "));
  if (skipped.length > 0) summary.append(" · ", strong(`${grouped(skipped.length)} skipped`));
  if (fitted > 0) summary.append(" · ", strong(`${grouped(fitted)} curves fitted`));
  const details = document.createElement("details");
  details.append(summary, list(report));
  return details;
}

function list({ kind, trims, exact, fitted, gap, unit, skipped, notes }: CadReport): HTMLElement {
  const suffix = unit === null ? "" : ` ${unitName(unit)}`;
  const lines = [
    ...(kind === "mesh"
      ? [`its triangles are up to ${upperText(gap)}${suffix} from what they stand for`]
      : [
          `${grouped(trims)} trimming curves: ${grouped(exact)} exact, ${grouped(fitted)} fitted`,
          `edges and faces of the file are up to ${upperText(gap)}${suffix} apart`,
        ]),
    ...skipped.slice(0, MAX_SKIPPED).map(skippedLine),
  ];
  const more = skipped.length - MAX_SKIPPED;
  if (more > 0) lines.push(`and ${grouped(more)} more skipped`);
  lines.push(...notes.slice(0, MAX_SKIPPED).map(({ face, why }) => `${called(face)}: ${why}`));
  const node = document.createElement("ul");
  node.append(
    ...lines.map((text) => {
      const line = document.createElement("li");
      line.textContent = text;
      return line;
    }),
  );
  return node;
}

function skippedLine({ face, entity, why }: SkippedFace): string {
  return `${called(face)}${entity === undefined ? "" : ` (#${entity})`} skipped: ${why}`;
}

const called = (face: number | string) => (typeof face === "number" ? `face ${face}` : face);

function strong(text: string): HTMLElement {
  const node = document.createElement("b");
  node.textContent = text;
  return node;
}
