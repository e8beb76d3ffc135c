// A program with a worker of its own, in which it runs the package.
const worker = new Worker(new URL("./in-worker.js", import.meta.url), { type: "module" });
globalThis.outcome = new Promise((resolve) => {
  worker.onmessage = ({ data }) => resolve(data);
  worker.onerror = ({ message }) => resolve({ error: message });
});
