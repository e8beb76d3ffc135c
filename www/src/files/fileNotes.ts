// Below each model, a line about its file: format, unit, faces, and everything
// that reading it left out or approximated, which unfolds to the details.

import type { CadReport, SkippedFace } from "nurbs-hausdorff/cad";
import { element } from "../common/elements.ts";
import { grouped, upperText } from "../common/text/numbers.ts";
import { unitName } from "../common/text/units.ts";
import { texts } from "../texts/index.ts";
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
  const isMeshOfTriangles = indices.length > 0;
  const count = (isMeshOfTriangles ? indices : positions).length / 3;
  const line = document.createElement("span");
  line.textContent = [
    isMeshOfTriangles ? texts.files.mesh : texts.files.points,
    (isMeshOfTriangles ? texts.files.triangles : texts.files.pointCount)(grouped(count), count),
    unit === null ? texts.files.unitUnknown : unitName(unit),
  ].join(" · ");
  return line;
}

/** Whether a report has nothing to say: that of a mesh which was read as a whole. */
const isSilent = ({ kind, skipped, notes }: CadReport): boolean =>
  kind === "mesh" && skipped.length === 0 && notes.length === 0;

function note(report: CadReport): HTMLElement {
  const { kind, reader, faces: read, unit, skipped, fitted } = report;
  const format = reader === "occt" ? texts.files.byOpenCASCADE(FORMATS[kind]) : FORMATS[kind];
  const summary = document.createElement("summary");
  const faces = texts.files.faces(grouped(read), read);
  summary.append(
    [format, faces, unit === null ? texts.files.unitUnknown : unitName(unit)].join(" · "),
  );
  if (skipped.length > 0)
    summary.append(" · ", strong(texts.files.skipped(grouped(skipped.length))));
  if (fitted > 0) summary.append(" · ", strong(texts.files.curvesFitted(grouped(fitted))));
  const details = document.createElement("details");
  details.append(summary, list(report));
  return details;
}

function list({ kind, trims, exact, fitted, gap, unit, skipped, notes }: CadReport): HTMLElement {
  const suffix = unit === null ? "" : ` ${unitName(unit)}`;
  const lines = [
    ...(kind === "mesh"
      ? [texts.files.itsTrianglesAreUpTo(upperText(gap), suffix)]
      : [
          texts.files.trimmingCurvesExactFitted(grouped(trims), grouped(exact), grouped(fitted)),
          texts.files.edgesAndFacesOfThe(upperText(gap), suffix),
        ]),
    ...skipped.slice(0, MAX_SKIPPED).map(skippedLine),
  ];
  const more = skipped.length - MAX_SKIPPED;
  if (more > 0) lines.push(texts.files.andMoreSkipped(grouped(more)));
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
  return texts.files.faceSkipped(called(face), entity === undefined ? "" : ` (#${entity})`, why);
}

const called = (face: number | string) =>
  typeof face === "number" ? texts.files.face(face) : face;

function strong(text: string): HTMLElement {
  const node = document.createElement("b");
  node.textContent = text;
  return node;
}
