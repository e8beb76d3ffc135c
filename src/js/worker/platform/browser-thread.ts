import type { Reply, Request } from "../messages.js";
import { serve } from "../serve.js";
import { browser } from "./browser.js";

/** The worker's own scope; the DOM's types know only the window's. */
const scope = globalThis as unknown as {
  location: { href: string };
  navigator: { hardwareConcurrency?: number };
  onmessage: (event: MessageEvent<Request>) => void;
  postMessage(reply: Reply, transfer: ArrayBuffer[]): void;
  importScripts(script: string): void;
};

/** Answers the calls of the page in this worker. */
export function serveBrowser(): void {
  const take = serve((reply, transfer) => scope.postMessage(reply, transfer), {
    connect: browser(() => new Worker(scope.location.href, { type: ownType() })),
    processors: () => scope.navigator.hardwareConcurrency ?? 1,
  });
  scope.onmessage = ({ data }) => take(data);
}

/** How this worker was started: only a script that is no module may import scripts. */
function ownType(): WorkerType {
  try {
    // Firefox does not throw without a script.
    scope.importScripts("data:text/javascript,");
    return "classic";
  } catch (error) {
    return error instanceof TypeError ? "module" : "classic";
  }
}
