import { full } from "../output/numbers.js";

/** The number of bins, and the width of each, in pixels. */
const BINS = 20;
const BIN_WIDTH = 30;
/** The height of the highest bar, in pixels. */
const HEIGHT = 100;
const WIDTH = BINS * BIN_WIDTH;

/** Faces by how far they are at most, with what is allowed; nothing where all faces coincide. */
export function histogram(uppers: number[], limit: number | undefined): string[] {
  const range = Math.max(0, ...uppers, limit ?? 0);
  if (uppers.length === 0 || !(range > 0 && Number.isFinite(range))) return [];
  const counts = new Array<number>(BINS).fill(0);
  for (const upper of uppers) {
    const bin = Math.min(BINS - 1, Math.floor((upper / range) * BINS));
    counts[bin] = (counts[bin] ?? 0) + 1;
  }
  const most = Math.max(1, ...counts);
  const below = HEIGHT + 14;
  return [
    "<figure>",
    `<svg class="histogram" viewBox="-10 -16 ${WIDTH + 20} ${HEIGHT + 50}" role="img" aria-label="Faces by how far they are at most">`,
    ...counts.flatMap((count, bin) => (count > 0 ? [bar(count, bin, most)] : [])),
    `<path d="M0,${HEIGHT}H${WIDTH}"/><text x="0" y="${below}">0</text><text x="${WIDTH}" y="${below}" text-anchor="end">${full(range)}</text>`,
    ...(limit !== undefined && Number.isFinite(limit) ? [mark(limit, range)] : []),
    "</svg>",
    "<figcaption>Faces of both models by how far they are at most</figcaption>",
    "</figure>",
  ];
}

function bar(count: number, bin: number, most: number): string {
  const height = Math.max(1, Math.floor((HEIGHT * count) / most));
  const [left, top] = [bin * BIN_WIDTH, HEIGHT - height];
  const rect = `<rect x="${left + 1}" y="${top}" width="${BIN_WIDTH - 2}" height="${height}"/>`;
  return `${rect}<text x="${left + BIN_WIDTH / 2}" y="${top - 3}" text-anchor="middle">${count}</text>`;
}

function mark(limit: number, range: number): string {
  const at = Math.floor((limit / range) * WIDTH);
  const anchor = limit > range / 2 ? "end" : "start";
  return `<path class="limit" d="M${at},-12V${HEIGHT}"/><text x="${at}" y="${HEIGHT + 28}" text-anchor="${anchor}">allowed ${full(limit)}</text>`;
}
