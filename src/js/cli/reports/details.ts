import { full } from "../output/numbers.js";
import { type Answer, STATUSES } from "./answer.js";
import { escapeXml } from "./escape.js";
import { histogram } from "./histogram.js";
import type { Row } from "./rows.js";

/** The largest number of faces of one pair in the report; JSON has all. */
const MAX_FACES = 200;

/** What a section without pictures says. */
const NO_PICTURES = "The sections before this one have pictures; there are no more in one report.";

/** What the report takes of an answer's JSON: that of a distance, or of a comparison face by face. */
interface Found {
  files?: Record<Side, { path: string; sha256: string }>;
  skipped?: Record<Side, unknown[]>;
  computed?: number;
  lower?: number;
  upper?: number;
  tolerance?: number;
  unit?: number;
  gap?: number;
  withGaps?: unknown;
  witness?: Witness;
  facesOfA?: Face[];
  facesOfB?: Face[];
}

type Side = "a" | "b";
type Witness = Record<Side, { face: number; faceName?: string; point: number[] }>;

interface Face {
  face: number;
  state: string;
  lower: number;
  upper: number;
  witness: Witness;
}

const SIDES = ["a", "b"] as const;

/** The section on one pair: verdict, what was allowed and found, where, files and faces. */
export function details(row: Row): string[] {
  if (!("answer" in row.outcome)) return [];
  const { answer } = row.outcome;
  const found = answer.json as Found;
  return [
    `<section class="pair status-${STATUSES[answer.verdict]}">`,
    `<h2>${escapeXml(row.path)}</h2>`,
    `<p><b class="badge">${badge(answer)}</b> ${escapeXml(`${answer.word}: ${answer.summary}`)}</p>`,
    "<dl>",
    ...terms(answer, found).map(([term, text]) => `<dt>${term}</dt><dd>${escapeXml(text)}</dd>`),
    "</dl>",
    ...files(found),
    answer.figures || `<p>${NO_PICTURES}</p>`,
    ...histogram(upperEnds(found), answer.limit),
    ...faces(found),
    "</section>",
  ];
}

function badge({ verdict, limit }: Answer): string {
  if (limit === undefined) return "NO VERDICT";
  return { passed: "PASS", failed: "FAIL", undecided: "UNDECIDED" }[verdict];
}

/** Terms with their texts, of those that the answer has. */
function terms({ limit }: Answer, found: Found): [term: string, text: string][] {
  const { computed, lower, upper, tolerance, unit, gap = 0, withGaps, witness } = found;
  const all: [string, string | undefined][] = [
    ["Allowed deviation", limit === undefined ? "not stated" : full(limit)],
    ["Found", number(computed)],
    ["Certified interval", interval({ lower, upper })],
    ["Precision", number(tolerance)],
    ["Gap of the files", gap > 0 ? full(gap) : undefined],
    ["With the gaps of the files", gap > 0 ? interval(withGaps) : undefined],
    ["Where", witness && SIDES.map((side) => place(side, witness)).join(", ")],
    ["At", witness?.a.point.map(full).join(", ")],
    ["Metres per unit", number(unit)],
  ];
  return all.flatMap(([term, text]) => (text === undefined ? [] : [[term, text]]));
}

const number = (value: number | undefined): string | undefined =>
  typeof value === "number" ? full(value) : undefined;

function interval(of: unknown): string | undefined {
  const { lower, upper } = of as { lower?: number; upper?: number };
  return typeof lower === "number" && typeof upper === "number"
    ? `[${full(lower)}, ${full(upper)}]`
    : undefined;
}

const place = (side: Side, { [side]: { face, faceName } }: Witness): string =>
  `${side.toUpperCase()} ${faceName || `face ${face}`}`;

function files({ files, skipped }: Found): string[] {
  const rows = SIDES.flatMap((side) => {
    const file = files?.[side];
    if (file === undefined) return [];
    const cells = [side.toUpperCase(), file.path, file.sha256, `${skipped?.[side].length ?? 0}`];
    return [tableRow("td", cells)];
  });
  return table(["", "File", "SHA-256", "Skipped faces"], rows);
}

/** How far each face of both models is at most. */
const upperEnds = ({ facesOfA = [], facesOfB = [] }: Found): number[] =>
  [...facesOfA, ...facesOfB].map(({ upper }) => upper).filter(Number.isFinite);

/** The faces of both models, the largest lower bound first. */
function faces({ facesOfA = [], facesOfB = [] }: Found): string[] {
  const all = [
    ...facesOfA.map((face) => ({ side: "a" as const, face })),
    ...facesOfB.map((face) => ({ side: "b" as const, face })),
  ].sort((one, other) => other.face.lower - one.face.lower);
  if (all.length === 0) return [];
  const rows = all.slice(0, MAX_FACES).map(({ side, face }) => {
    const { state, lower, upper, witness } = face;
    const at = witness[side].point.map(full).join(", ");
    return tableRow("td", [place(side, witness), state, full(lower), full(upper), at]);
  });
  const more = all.length - rows.length;
  const rest = more > 0 ? [`<p>and ${more} more faces, which the JSON has</p>`] : [];
  return [...table(["Face", "State", "At least", "At most", "At"], rows), ...rest];
}

const table = (head: string[], rows: string[]): string[] => [
  "<table>",
  `<thead>${tableRow("th", head)}</thead>`,
  "<tbody>",
  ...rows,
  "</tbody>",
  "</table>",
];

const tableRow = (name: string, cells: string[]): string =>
  `<tr>${cells.map((cell) => `<${name}>${escapeXml(cell)}</${name}>`).join("")}</tr>`;
