import { readFileSync } from "node:fs";
import { deflateSync } from "node:zlib";
import { translating } from "../../error.js";
import type { Transform, Vector3 } from "../../measure/options.js";
import type { NurbsModel } from "../../model/model.js";
import { Hausdorff } from "../../node.js";
import { drawPictures, initSync, PictureMap } from "../../wasm/nurbs_hausdorff_pictures.js";
import type { Input } from "../files.js";
import { escapeXml } from "./escape.js";

/** The distance of triangles from their model, in its diagonals, as of the native command. */
const FLATNESS = 1e-3;

/** The permitted excess of a distance, in diagonals: a tenth of the least deviation that has a colour. */
const EXCESS = 5e-8;

/** The deviation, in diagonals, up to which there is no colour, and no sign is needed. */
const FLOOR = 5e-7;

/** What is known of a model that is shown, and shown with it. */
export interface ShownModel {
  /** An upper bound on the distance of all its points, or one for each face. */
  uppers: number[];
  /** The farthest point found, with its nearest point on the other model. */
  farthest: { face: number; point: Vector3; foot: Vector3 } | undefined;
}

/** What pictures show of two models. */
export interface Shown {
  allowed: number | undefined;
  a?: ShownModel;
  b?: ShownModel;
  transform: Transform | undefined;
}

/** What the module draws. */
interface Pictures {
  figures: {
    caption: string;
    pictures: { alt: string; size: [number, number]; png: Uint8Array }[];
  }[];
  legend: string;
}

/** Both models in a result. */
interface Pair {
  hd: Hausdorff;
  models: readonly [a: NurbsModel, b: NurbsModel];
  transform: Transform | undefined;
  /** A's units in one of B's. */
  scale: number;
  /** The larger diagonal, in A's unit. */
  diagonal: number;
}

/** Draws two models; the addresses of the pictures contain them. */
export async function figures(a: Input, b: Input, shown: Shown): Promise<string> {
  const module = new URL("../../wasm/nurbs_hausdorff_pictures_bg.wasm", import.meta.url);
  initSync({ module: readFileSync(module) });
  using hd = await Hausdorff.create({ backend: "cpu" });
  const models = [a.model, b.model] as const;
  const [unitOfA, unitOfB] = models.map(({ unit }) => unit);
  const scale = unitOfA && unitOfB ? unitOfB / unitOfA : 1;
  const diagonal = Math.max(diagonalOf(a.model), scale * diagonalOf(b.model));
  const pair: Pair = { hd, models, transform: shown.transform, scale, diagonal };
  const maps = [await mapOf("a", shown.a, pair), await mapOf("b", shown.b, pair)] as const;
  const unit = unitOfA ?? unitOfB ?? undefined;
  const compressed = (bytes: Uint8Array) => deflateSync(bytes);
  const drawn = translating(
    () => drawPictures(...maps, diagonal, unit, shown.allowed, compressed) as Pictures,
  );
  return htmlOf(drawn);
}

/** Measures the points that the map of a model needs. */
async function mapOf(
  side: "a" | "b",
  shown: ShownModel | undefined,
  { hd, models, transform, scale, diagonal }: Pair,
): Promise<PictureMap | undefined> {
  if (shown === undefined) return undefined;
  const [model, other] = side === "a" ? models : [models[1], models[0]];
  const triangles = model.tessellate({ relativeTolerance: FLATNESS });
  const { positions, normals, indices, origin, faces } = triangles;
  const counts = Uint32Array.from(faces, ({ indexCount }) => indexCount);
  // Files with faces have a report on reading them; those of meshes and points have none.
  const isMesh = model.report === null;
  const { rotation = [0, 0, 0, 1], translation = [0, 0, 0] } = transform ?? {};
  const map = translating(
    () =>
      new PictureMap(
        ...([positions, normals, indices, counts] as const),
        ...([new Float64Array(origin), isMesh, side === "a"] as const),
        ...([new Float64Array(rotation), new Float64Array(translation)] as const),
        ...([scale, diagonal, shown] as const),
      ),
  );
  const signTolerance = (FLOOR * diagonal) / (side === "a" ? scale : 1);
  const options = { relativeTolerance: EXCESS, signTolerance };
  let isSolid = false;
  for (let points = map.pending(); points.length > 0; points = map.pending()) {
    const found = await hd.closestPoints(other, points, options);
    isSolid = found.signs === "solid";
    map.measured(found.signed, found.distances);
  }
  map.finish(isSolid);
  return map;
}

function diagonalOf({ boundingBox: { min, max } }: NurbsModel): number {
  return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

function htmlOf({ figures, legend }: Pictures): string {
  const image = ({ alt, size: [width, height], png }: Pictures["figures"][0]["pictures"][0]) => {
    const base64 = Buffer.from(png).toString("base64");
    const size = `width="${width}" height="${height}"`;
    return `<img ${size} alt="${escapeXml(alt)}" src="data:image/png;base64,${base64}">`;
  };
  const lines = figures.flatMap(({ caption, pictures }) => [
    '<figure class="views">',
    "<div>",
    ...pictures.map(image),
    legend,
    "</div>",
    `<figcaption>${escapeXml(caption)}</figcaption>`,
    "</figure>",
  ]);
  return lines.join("\n");
}
