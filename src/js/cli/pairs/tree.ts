import { readdir, stat } from "node:fs/promises";
import { join } from "node:path";
import picomatch from "picomatch";
import { HausdorffError } from "../../error.js";
import { failed } from "../files.js";

/** The endings of the files compared where no pattern is given; gzip may have compressed them. */
const ENDINGS =
  /\.(3dm|3mf|brep|brp|csv|e57|fcstd|glb|gltf|iges|igs|json|las|laz|obj|ply|pts|step|stl|stp|txt|xyz)(\.gz)?$/i;

/** A relative path, with `/` between its parts, and the files that it names in A and B. */
export interface TreePair {
  path: string;
  a?: string;
  b?: string;
}

/**
 * The files whose relative path matches a pattern, or which have an ending of a model if there is
 * none, in the order of their paths.
 */
export async function treePairs(
  a: string,
  b: string,
  pattern: string | undefined,
): Promise<TreePair[]> {
  // A pattern without `/` matches names in every folder.
  const basename = pattern !== undefined && !pattern.includes("/");
  const matches = pattern === undefined ? undefined : picomatch(pattern, { basename, dot: true });
  const isIncluded = matches ?? ((path: string) => ENDINGS.test(path));
  const pairs = new Map<string, TreePair>();
  for (const [side, root] of Object.entries({ a, b })) {
    for (const path of await files(root)) {
      if (!isIncluded(path)) continue;
      const pair = pairs.get(path) ?? { path };
      pairs.set(path, Object.assign(pair, { [side]: join(root, path) }));
    }
  }
  // A check of nothing does not pass.
  if (pairs.size === 0) {
    throw new HausdorffError("OPTION_INVALID", `no file of ${a} or ${b} is a model to compare`);
  }
  return [...pairs.values()].sort((one, other) => Buffer.compare(bytes(one), bytes(other)));
}

const bytes = ({ path }: TreePair): Buffer => Buffer.from(path);

/** The relative paths of all files below a directory; links are followed. */
async function files(root: string, below = ""): Promise<string[]> {
  const found: string[] = [];
  try {
    for (const name of await readdir(join(root, below))) {
      const path = below === "" ? name : `${below}/${name}`;
      const entry = await stat(join(root, path));
      if (entry.isDirectory()) found.push(...(await files(root, path)));
      else if (entry.isFile()) found.push(path);
    }
  } catch (cause) {
    if (cause instanceof Error && "code" in cause && cause.code === "FILE_UNREADABLE") throw cause;
    throw failed("FILE_UNREADABLE", join(root, below), cause);
  }
  return found;
}
