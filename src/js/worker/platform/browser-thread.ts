import type { Reply, Request } from "../messages.js";
import { serve } from "../serve.js";

/** The worker's own scope; the DOM's types know only the window's. */
const scope = globalThis as unknown as {
  onmessage: (event: MessageEvent<Request>) => void;
  postMessage(reply: Reply, transfer: ArrayBuffer[]): void;
};

/** Answers the calls of the page in this worker. */
export function serveBrowser(): void {
  const take = serve((reply, transfer) => scope.postMessage(reply, transfer));
  scope.onmessage = ({ data }) => take(data);
}
