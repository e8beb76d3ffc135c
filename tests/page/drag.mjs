// A slider dragged, while what the page shows is recorded.

/** Milliseconds between two moves: a display's frame. */
const FRAME = 16;
/** Moves from one end of the way to the other. */
const MOVES = 60;
/** The ends, in diagonals. */
const FROM = 0.02;
const TO = 0.5;
/** Milliseconds of a drag at most: the machine may be busy with other things. */
const LONGEST = 40_000;

/**
 * Drags the slider to and fro until `wanted` different distances were shown,
 * and returns what the read-out said meanwhile: the results, and the heights
 * that parts of the panel stood at. By the page's own timer, as the mouse of
 * a browser without a display waits for frames, which are slow in software.
 */
export const drag = (page, slider, wanted) =>
  page.evaluate(
    async ({ slider, wanted, frame, moves, from, to, longest }) => {
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
      for (let step = 1; results.length < wanted && elapsed() < longest; step++) {
        const part = 1 - Math.abs(1 - ((step / moves) % 2));
        input.value = from + (to - from) * part;
        input.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, frame));
      }
      observer.disconnect();
      const perSecond = (1000 * results.length) / elapsed();
      return { results, heights: [...heights], perSecond };
    },
    { slider, wanted, frame: FRAME, moves: MOVES, from: FROM, to: TO, longest: LONGEST },
  );
