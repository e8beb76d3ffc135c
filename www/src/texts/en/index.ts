// All texts of the page in English, by its parts.
import { bodies } from "./bodies.ts";
import { common } from "./common.ts";
import { experiments } from "./experiments.ts";
import { faces } from "./faces.ts";
import { files } from "./files.ts";
import { measuring } from "./measuring.ts";
import { places } from "./places.ts";
import { report } from "./report.ts";
import { results } from "./results.ts";

export const en = {
  /** As browsers know it. */
  language: "en",
  ...{ common, files, places, measuring, faces, bodies, results, report, experiments },
};
