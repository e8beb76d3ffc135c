// What the report says, from the state of the page.
import { element } from "../../common/elements.ts";
import { placeName } from "../../common/text/names.ts";
import {
  certifiedText,
  distanceText,
  intervalText,
  signedText,
} from "../../common/text/numbers.ts";
import { unitName } from "../../common/text/units.ts";
import { hashOf } from "../../files/identity.ts";
import { commonUnit, modelUnit } from "../../files/units.ts";
import { isBeyond, sizeText } from "../../inspection/places/placeList.ts";
import type { Place } from "../../inspection/places/places.ts";
import { limitText } from "../../results/ownLimits.ts";
import { allowed, allowedOf, shownVerdict } from "../../results/verdict.ts";
import { type DisplayModel, SIDES, type Sides } from "../../worker/protocol.ts";
import type { ExportedState } from "../exports.ts";
import type { ReportContent } from "./report.ts";

/** Faces in the table; a longer one is for the JSON. */
const MAX_FACES = 200;

/** Everything but the pictures. */
export async function contentOf(
  state: ExportedState,
): Promise<Omit<ReportContent, "views" | "places">> {
  const { result, models, places, pins, tables } = state;
  const diagonal = result?.diagonal ?? 1;
  return {
    verdict: { verdict: shownVerdict().verdict, terms: verdictTerms(state) },
    files: await Promise.all(
      SIDES.map(async (side) => ({
        title: side.toUpperCase(),
        terms: await fileTerms(models, side),
      })),
    ),
    faces: {
      head: ["Face", "Least", "Most", "Largest", "Allowed", ""],
      rows: places.slice(0, MAX_FACES).map((place) => faceRow(place, diagonal)),
    },
    pins: pins.map(({ side, face, point, distance, signed }) => [
      `${side.toUpperCase()} ${face}`,
      point.map((at) => distanceText(at, diagonal)).join(", "),
      Number.isNaN(signed) ? distanceText(distance, diagonal) : signedText(signed, diagonal),
    ]),
    tables,
    settings: settingsOf(state),
  };
}

function verdictTerms({ result }: ExportedState): [string, string][] {
  if (result === undefined) return [];
  const { lower, upper, computed, diagonal, gap, withGaps, witness } = result;
  const unit = commonUnit() ?? "model units";
  const limits = allowed();
  const limit =
    limits === undefined
      ? "not stated"
      : `+${limits.above} / −${limits.below} ${modelUnit() ?? "model units"}`;
  return [
    ["Measured", element("kind").textContent ?? ""],
    ["Allowed deviation", limit],
    ["Found", `${certifiedText(computed, [lower, upper], diagonal)} ${unit}`],
    ["Certified interval", `${intervalText(lower, upper, diagonal)} ${unit}`],
    ["Where", `A ${placeName(witness.a)}, B ${placeName(witness.b)}`],
    ["At", witness.a.point.map((at) => distanceText(at, diagonal)).join(", ")],
    [
      "With the gaps of the files",
      gap > 0
        ? `${intervalText(Math.max(0, withGaps.lower), withGaps.upper, diagonal)} ${unit}`
        : "",
    ],
  ];
}

async function fileTerms(
  models: Sides<DisplayModel>,
  side: "a" | "b",
): Promise<[string, string][]> {
  const model = models[side];
  if (model === undefined) return [];
  const { source, faceCount, unit, report } = model;
  const common: [string, string][] = [
    ["Faces", `${faceCount}`],
    ["Unit", unit === null ? "unknown" : unitName(unit)],
    ["Skipped faces", report === null ? "" : `${report.skipped.length}`],
    ["Gap of the file", report === null ? "" : `${report.gap}`],
  ];
  if ("shape" in source) return [["Model", source.shape], ...common];
  const { file } = source;
  return [
    ["File", file.name],
    ["Bytes", `${file.size}`],
    ["Changed", new Date(file.lastModified).toISOString()],
    ["SHA-256", await hashOf(file)],
    ...common,
  ];
}

function faceRow(place: Place, diagonal: number): string[] {
  const { side, name, lowest, highest } = place;
  const limits = allowedOf(side, place.face);
  return [
    `${side.toUpperCase()} ${name}`,
    signedText(lowest, diagonal),
    signedText(highest, diagonal),
    sizeText(place, diagonal),
    limits === undefined ? "" : limitText(limits),
    limits === undefined ? "" : isBeyond(place, limits) ? "beyond" : "within",
  ];
}

function settingsOf({ options }: ExportedState): [string, string][] {
  const { method, relativeTolerance, symmetric, transform } = options;
  const rotation = transform?.rotation ?? [0, 0, 0, 1];
  return [
    ["Method", `${method}`],
    ["Precision", `${relativeTolerance} of the diagonal`],
    ["Distance", symmetric ? "symmetric: the larger of A from B and B from A" : "directed, A to B"],
    ["Translation of A", (transform?.translation ?? [0, 0, 0]).join(", ")],
    ["Rotation of A, quaternion", rotation.join(", ")],
  ];
}
