// `nurbs-hausdorff/worker`: the package, all of whose work is done in a worker.
import { connectBy } from "./hausdorff.js";

connectBy((listener, given) => {
  // Bundlers recognise this expression, and bundle the file that it names.
  const worker = given ?? new Worker(new URL("./thread.js", import.meta.url), { type: "module" });
  worker.onmessage = ({ data }) => listener.message(data);
  worker.onerror = (event) => {
    listener.failed(`the worker failed: ${event.message ?? "it could not be started"}`);
  };
  return {
    post: (message, transfer) => worker.postMessage(message, transfer),
    hold: () => {},
    close: () => worker.terminate(),
  };
});

export * from "./exports.js";
