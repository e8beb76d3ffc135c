// Drags a slider and records what the page shows meanwhile.

/** Milliseconds between two moves, about one frame of a display. */
const FRAME = 16;
/** Moves from one end of the range to the other. */
const MOVES = 60;
/** The ends of the range, in diagonals. */
const FROM = 0.02;
const TO = 0.5;
/** The maxDuration drag, in milliseconds; a busy machine is slow. */
const MAX_DURATION = 40_000;

/**
 * Drags the slider to and fro until `count` different distances were shown.
 * Returns the results shown meanwhile and the heights of parts of the panel.
 * The moves use the page's own timer, because mouse events of a headless
 * browser wait for frames, which are slow in software.
 */
export const drag = (page, slider, count) =>
  page.evaluate(
    async ({ slider, count, frame, moves, from, to, maxDuration }) => {
      const input = document.querySelector(slider);
      const result = document.getElementById("result");
      const results = [];
      const heights = new Set();
      let last = result.dataset.computed;
      const observer = new MutationObserver(() => {
        for (const id of ["preset", "facts"]) {
          heights.add(`${id} at ${document.getElementById(id).getBoundingClientRect().top}`);
        }
        const { state, computed, lower, upper } = result.dataset;
        if ((state !== "live" && state !== "done") || computed === last) return;
        last = computed;
        const text = document.getElementById("distance").textContent;
        results.push({ computed, lower: Number(lower), upper: Number(upper), text });
      });
      observer.observe(result, { attributes: true });
      const begin = performance.now();
      const elapsed = () => performance.now() - begin;
      for (let step = 1; results.length < count && elapsed() < maxDuration; step++) {
        const part = 1 - Math.abs(1 - ((step / moves) % 2));
        input.value = from + (to - from) * part;
        input.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, frame));
      }
      observer.disconnect();
      const perSecond = (1000 * results.length) / elapsed();
      return { results, heights: [...heights], perSecond };
    },
    { slider, count, frame: FRAME, moves: MOVES, from: FROM, to: TO, maxDuration: MAX_DURATION },
  );
