// The worker that computes the hash of a large file, for which browsers stop the page.
import { sha256Of } from "./hash.ts";

self.onmessage = async ({ data }: MessageEvent<File>) => {
  // Without an answer the page's promise would wait for ever.
  self.postMessage(await sha256Of(data).catch(() => undefined));
};
