// The npm packages, exactly as in package-lock.json.
import { must } from "../process.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

const made = "node_modules/.installed-from";

export async function packages() {
  const lock = digest(["package-lock.json"]);
  if (stamped(made, lock)) return "present";
  await must("npm", ["ci", "--no-audit", "--no-fund"]);
  stamp(made, lock);
  return "installed";
}
