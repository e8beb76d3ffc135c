// npm start: set up, build, and serve the page.
import { spawn } from "node:child_process";
import { buildForPage } from "./build/index.mjs";
import { inRoot, root } from "./paths.mjs";
import { environment, Failure } from "./process.mjs";
import { setUpForPage } from "./setup/index.mjs";

try {
  await setUpForPage();
  await buildForPage();
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exit(1);
}

// Vite prints the address. Further arguments are passed to it: npm start -- --port 8080
const vite = spawn(inRoot("node_modules/.bin/vite"), ["www", ...process.argv.slice(2)], {
  cwd: root,
  env: environment(),
  stdio: "inherit",
});
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) {
  process.removeAllListeners(signal);
  process.on(signal, () => vite.kill(signal));
}
vite.on("exit", (status) => process.exit(status ?? 0));
