// Paths: the checkout, and the user's cache, which all checkouts share for
// files that take long to make (built tools, a Vulkan driver).
import { homedir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const root = dirname(dirname(fileURLToPath(import.meta.url)));

export const cache = join(
  process.env.XDG_CACHE_HOME || join(homedir(), ".cache"),
  "nurbs-hausdorff",
);

/** Returns a path inside the checkout. */
export const inRoot = (...parts) => join(root, ...parts);
