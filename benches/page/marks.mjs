// When the page reached which state: runs in the page.

/** Notes in `window.marks` when each state of the page is reached first, from now on; `name` is that of B's file. */
export function watch(name) {
  const started = performance.now();
  window.marks = {};
  const mark = (what) => {
    window.marks[what] ??= performance.now() - started;
  };
  const look = () => {
    const loading = document.getElementById("loading");
    if (!loading.hidden && /reading/.test(loading.textContent)) mark("first faces");
    const chosen = document.querySelector("#shape-b option:checked")?.textContent ?? "";
    if (!loading.hidden || !chosen.includes(name)) return;
    mark("drawn");
    const { lower, state } = document.getElementById("result").dataset;
    if (lower !== undefined) mark("interval");
    if (state === "done") mark("colours");
  };
  const all = { subtree: true, childList: true, attributes: true, characterData: true };
  new MutationObserver(look).observe(document.body, all);
}
