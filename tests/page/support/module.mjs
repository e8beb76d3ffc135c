// Modules of the page that need no browser.
import { build } from "esbuild";

/** Imports a module of the page by its path in its sources. */
export async function moduleOf(path) {
  const { outputFiles } = await build({
    ...{ entryPoints: [`www/src/${path}`], bundle: true, format: "esm", write: false },
    // Where workers of the page would be.
    define: { "import.meta.url": '"file:///page/"' },
  });
  return import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`);
}
