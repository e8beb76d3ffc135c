import { createRequire } from "node:module";

/** What to do on a platform without a program. */
export const advice =
  "cargo install nurbs-hausdorff-command builds it; where npm was told to leave out optional packages, " +
  "install again with --include=optional";

/** The native program in the package of this platform, which npm installs beside this one. */
export function program(): string | undefined {
  const ending = process.platform === "win32" ? ".exe" : "";
  const name = `@nurbs-hausdorff/${process.platform}-${process.arch}/nurbs-hausdorff${ending}`;
  try {
    return createRequire(import.meta.url).resolve(name);
  } catch {
    return undefined;
  }
}
