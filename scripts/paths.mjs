// Where things are: the checkout, and the folder shared by all checkouts of
// this user for what takes long to make (built tools, a Vulkan driver).
import { homedir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const root = dirname(dirname(fileURLToPath(import.meta.url)));

export const cache = join(
  process.env.XDG_CACHE_HOME || join(homedir(), ".cache"),
  "nurbs-hausdorff",
);

/** A path inside the checkout. */
export const inRoot = (...parts) => join(root, ...parts);
