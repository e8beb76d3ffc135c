// The memory of the browser's processes.
import { readdirSync, readFileSync } from "node:fs";

/** The resident memory of the renderers that this process started, in MiB. */
export function resident() {
  const all = readdirSync("/proc").filter((name) => /^\d+$/.test(name));
  const parents = new Map();
  const sizes = new Map();
  for (const id of all) {
    try {
      const command = readFileSync(`/proc/${id}/cmdline`, "utf8");
      const status = readFileSync(`/proc/${id}/status`, "utf8");
      parents.set(id, /^PPid:\s+(\d+)/m.exec(status)[1]);
      if (command.includes("--type=renderer")) sizes.set(id, Number(/^VmRSS:\s+(\d+)/m.exec(status)[1]));
    } catch {
      // It ended meanwhile.
    }
  }
  const isOwn = (id) => id === `${process.pid}` || (parents.has(id) && isOwn(parents.get(id)));
  const own = [...sizes].filter(([id]) => isOwn(id));
  return own.reduce((sum, [, size]) => sum + size, 0) / 1024;
}
