// What the report says, from the state of the page.

import { element } from "../../common/elements.ts";
import { placeName } from "../../common/text/names.ts";
import {
  certifiedText,
  distanceText,
  intervalText,
  shownLength,
  signedText,
} from "../../common/text/numbers.ts";
import { unitName } from "../../common/text/units.ts";
import { hashOf } from "../../files/identity.ts";
import { commonUnit } from "../../files/units.ts";
import { sizeText, stateOf } from "../../inspection/places/placeList.ts";
import type { Place } from "../../inspection/places/places.ts";
import { limitText } from "../../results/ownLimits.ts";
import { allowed, allowedOf, shownVerdict } from "../../results/verdict.ts";
import type { Allowed } from "../../scene/colors/scale.ts";
import { texts } from "../../texts/index.ts";
import { type DisplayModel, SIDES, type Sides } from "../../worker/protocol.ts";
import type { ExportedState } from "../exports.ts";
import type { ReportContent } from "./report.ts";

/** Faces in the table; a longer one is for the JSON. */
const MAX_FACES = 200;

/** Digits of a limit in another unit than that in which it is typed. */
const LIMIT_DIGITS = 12;

/** Everything but the pictures. */
export async function contentOf(
  state: ExportedState,
): Promise<Omit<ReportContent, "views" | "places">> {
  const { result, models, places, pins, tables } = state;
  const diagonal = result?.diagonal ?? 1;
  return {
    verdict: verdictOf(state),
    files: await Promise.all(
      SIDES.map(async (side) => ({
        title: side.toUpperCase(),
        terms: await fileTerms(models, side),
      })),
    ),
    faces: {
      head: [
        `${texts.report.face}, ${commonUnit() ?? texts.report.modelUnits}`,
        texts.report.least,
        texts.report.most,
        texts.report.largest,
        texts.report.allowed,
        "",
      ],
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

/** The verdict on the deviation, or what is found of the clearance that is measured instead. */
function verdictOf(state: ExportedState): ReportContent["verdict"] {
  const { clearance } = state;
  const { verdict, text } = shownVerdict();
  if (clearance === undefined) {
    const title = verdict === undefined ? texts.report.noVerdict : texts.results.verdicts[verdict];
    return { verdict, title, text, terms: verdictTerms(state) };
  }
  const title = texts.bodies.states[clearance.meeting].toUpperCase();
  return { verdict: undefined, title, text: clearance.text, terms: [] };
}

function verdictTerms({ result }: ExportedState): [string, string][] {
  if (result === undefined) return [];
  const { lower, upper, computed, diagonal, gap, withGaps, witness } = result;
  const unit = commonUnit() ?? texts.report.modelUnits;
  const limits = allowed();
  const shown = limits && shownLimits(limits);
  const limit = shown ? `+${shown.above} / −${shown.below} ${unit}` : texts.report.notStated;
  return [
    [texts.report.measured, element("kind").textContent ?? ""],
    [texts.report.allowedDeviation, limit],
    [texts.report.found, `${certifiedText(computed, [lower, upper], diagonal)} ${unit}`],
    [texts.report.certifiedInterval, `${intervalText(lower, upper, diagonal)} ${unit}`],
    [texts.report.where, `A ${placeName(witness.a)}, B ${placeName(witness.b)}`],
    [texts.report.at, witness.a.point.map((at) => distanceText(at, diagonal)).join(", ")],
    [
      texts.report.withTheGapsOfThe,
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
    [texts.report.faces, `${faceCount}`],
    [texts.report.unit, unit === null ? texts.report.unknown : unitName(unit)],
    [texts.report.skippedFaces, report === null ? "" : `${report.skipped.length}`],
    [texts.report.gapOfTheFile, report === null ? "" : lengthOf(report.gap, unit)],
  ];
  if ("shape" in source) return [[texts.report.model, source.shape], ...common];
  const { file } = source;
  return [
    [texts.report.file, file.name],
    [texts.report.bytes, `${file.size}`],
    [texts.report.changed, new Date(file.lastModified).toISOString()],
    [texts.report.sha256, await hashOf(file)],
    ...common,
  ];
}

/** A length of a file, in its own unit. */
const lengthOf = (length: number, unit: number | null): string =>
  `${length} ${unit === null ? texts.report.modelUnits : unitName(unit)}`;

function faceRow(place: Place, diagonal: number): string[] {
  const { side, name, lowest, highest } = place;
  const limits = allowedOf(side, place.face);
  return [
    `${side.toUpperCase()} ${name}`,
    signedText(lowest, diagonal),
    signedText(highest, diagonal),
    sizeText(place, diagonal),
    limits === undefined ? "" : limitText(shownLimits(limits)),
    limits === undefined ? "" : texts.report.faceStates[stateOf(place, limits)],
  ];
}

/** Limits in the unit in which lengths are shown. */
const shownLimits = ({ above, below }: Allowed): Allowed => ({
  above: Number(shownLength(above).toPrecision(LIMIT_DIGITS)),
  below: Number(shownLength(below).toPrecision(LIMIT_DIGITS)),
});

function settingsOf({ options, clearance }: ExportedState): [string, string][] {
  const { method, relativeTolerance, symmetric, transform } = options;
  const rotation = transform?.rotation ?? [0, 0, 0, 1];
  return [
    [texts.report.method, `${method}`],
    [texts.report.precision, texts.report.ofTheDiagonal(relativeTolerance)],
    [
      texts.report.distance,
      clearance !== undefined
        ? texts.report.theLeastOfAFromB
        : symmetric
          ? texts.report.symmetricTheLargerOfA
          : texts.report.directedAToB,
    ],
    [texts.report.translationOfA, (transform?.translation ?? [0, 0, 0]).join(", ")],
    [texts.report.rotationOfAQuaternion, rotation.join(", ")],
  ];
}
