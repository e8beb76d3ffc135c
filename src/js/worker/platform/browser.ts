import type { Connect } from "../messages.js";

/** Connects to the caller's worker, or to the one that `start` starts. */
export const browser =
  (start: () => Worker): Connect =>
  (listener, given) => {
    const worker = given ?? start();
    worker.onmessage = ({ data }) => listener.message(data);
    worker.onerror = (event) => {
      listener.failed(`the worker failed: ${event.message ?? "it could not be started"}`);
    };
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      hold: () => {},
      close: () => worker.terminate(),
    };
  };
