// The tasks of the page's main thread, from Chromium's trace.

const CATEGORIES = ["disabled-by-default-devtools.timeline", "blink.user_timing"];
/** An event that names the page's process and main thread. */
const MARK = "the page's main thread";

/** Begins a trace of the browser of this page; the function returned ends it. */
export async function trace(page) {
  const session = await page.context().browser().newBrowserCDPSession();
  await session.send("Tracing.start", {
    transferMode: "ReturnAsStream",
    traceConfig: { includedCategories: CATEGORIES },
  });
  return async () => {
    await page.evaluate((mark) => performance.mark(mark), MARK);
    const complete = new Promise((resolve) => session.once("Tracing.tracingComplete", resolve));
    await session.send("Tracing.end");
    const { stream: handle } = await complete;
    const parts = [];
    for (let eof = false; !eof; ) {
      const part = await session.send("IO.read", { handle });
      parts.push(Buffer.from(part.data, part.base64Encoded ? "base64" : "utf8"));
      eof = part.eof;
    }
    await session.detach();
    return JSON.parse(Buffer.concat(parts).toString("utf8")).traceEvents;
  };
}

/**
 * The milliseconds of its own CPU that each task of the page's main thread
 * took, the longest first: other programs add nothing to them.
 */
export function mainThreadTasks(events) {
  const mark = events.find(({ name }) => name === MARK);
  return events
    .filter(
      ({ name, ph, pid, tid }) =>
        name === "RunTask" && ph === "X" && pid === mark?.pid && tid === mark?.tid,
    )
    .map(({ tdur }) => (tdur ?? 0) / 1000)
    .sort((one, other) => other - one);
}
