import "./direct.js";

globalThis.outcome.then((outcome) => globalThis.postMessage(outcome));
