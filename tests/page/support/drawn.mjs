// Waits until the page has drawn what it has to.

/** Frames in which nothing is pending: what is observed in one is drawn in the next. */
const FRAMES = 3;

/** Waits until the view is drawn and nothing is in motion. */
export const drawn = (page) =>
  page.waitForFunction((frames) => {
    const isPending =
      document.getElementById("canvas")?.dataset.state === "pending" ||
      document.getAnimations().some(({ playState }) => playState === "running");
    window.calmFrames = isPending ? 0 : (window.calmFrames ?? 0) + 1;
    if (window.calmFrames < frames) return false;
    window.calmFrames = 0;
    return true;
  }, FRAMES);
