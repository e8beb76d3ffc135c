// The npm packages, exactly as in their lock files.
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

/** The packages of a folder with a lock file. */
function locked(...folder) {
  const path = (name) => [...folder, name].join("/");
  const made = path("node_modules/.installed-from");
  const lock = () => digest([path("package-lock.json")]);
  return {
    present: () => stamped(made, lock()),
    install: async () => {
      if (stamped(made, lock())) return "present";
      await must("npm", ["ci", "--no-audit", "--no-fund"], { cwd: inRoot(...folder) });
      stamp(made, lock());
      return "installed";
    },
  };
}

/** The packages of this one. */
export const packages = locked();

/** The generator of the API's pages. */
export const siteGenerator = locked("tools", "site");
