// npm run picture: build, and write the README's picture of the page anew.
// The page's own test takes it, so it shows what the tests have checked.
import { buildForPage } from "./build/index.mjs";
import { inRoot } from "./paths.mjs";
import { environment, Failure, must, which } from "./process.mjs";
import { setUpForTests } from "./setup/index.mjs";

const picture = inRoot("docs/images/page.png");
const test = ["--test-name-pattern", "two brackets", "tests/page/inspector/first.test.mjs"];

try {
  await setUpForTests();
  await buildForPage();
  await must("vite", ["build", "www"]);
  const env = environment({ CHROMIUM: which("chromium"), PICTURE: picture });
  await must("node", ["--test", "--test-reporter=spec", ...test], { env });
  console.log(`wrote ${picture}`);
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
