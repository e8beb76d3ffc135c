// The page of a deforming surface: measures it frame after frame, and draws what is measured.

import { Hausdorff } from "nurbs-hausdorff/worker";
import { element } from "../common/elements.ts";
import { intervalText } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import { codeOf, messageOf } from "../worker/failure.ts";
import { type Frame, Frames } from "./frames.ts";
import { LiveChart } from "./liveChart.ts";
import { Rate } from "./rate.ts";
import { DeformingScene } from "./scene.ts";
import { onSettings, settings } from "./settings.ts";

const state = element("run").dataset;
const pause = element("pause", HTMLButtonElement);
const [interval, rate, time] = ["interval", "rate", "time"].map((id) => element(id)) as [
  HTMLElement,
  HTMLElement,
  HTMLElement,
];
const distances = new LiveChart(element("chart-distance"), [
  { label: texts.experiments.upperBound, color: "accent" },
  { label: texts.experiments.lowerBound, color: "a" },
]);
const times = new LiveChart(
  element("chart-time"),
  [{ label: texts.experiments.aFrame, color: "a" }],
  {
    logarithmic: true,
  },
);
const counted = new Rate();
const scene = await openScene();

let frames: Frames | undefined;
/** Settles when no frame is being measured. */
let running: Promise<void> = Promise.resolve();
let angle = 0;
/** When the current run began, in seconds. */
let began = 0;
/** The number of the newest run. */
let newest = 0;

async function openScene(): Promise<DeformingScene | undefined> {
  try {
    return await DeformingScene.open(element("canvas", HTMLCanvasElement));
  } catch (error) {
    fail(error);
    return undefined;
  }
}

function fail(error: unknown): void {
  const box = element("error");
  box.hidden = false;
  box.textContent = `${messageOf(error)} (${codeOf(error)})`;
}

function show({ result, triangles, angle: at, milliseconds }: Frame): void {
  const now = performance.now() / 1000 - began;
  counted.add(now);
  distances.add(now, [result.upper, result.lower]);
  times.add(now, [milliseconds]);
  interval.textContent = intervalText(result.lower, result.upper, result.diagonal);
  rate.textContent = counted.perSecond.toFixed(1);
  time.textContent = `${milliseconds.toFixed(1)} ms`;
  scene?.show(triangles, result);
  // Tests and other programs read the last frame here.
  Object.assign(state, { angle: at, lower: result.lower, upper: result.upper });
  Object.assign(state, { frames: counted.total, rate: counted.perSecond });
}

/** Measures frames until a newer run is requested or the user pauses. */
async function run(hausdorff: Hausdorff, id: number): Promise<void> {
  try {
    frames = await Frames.create(hausdorff, settings());
    scene?.showPart(await frames.part());
    if (id !== newest) return;
    for (const chart of [distances, times]) chart.clear();
    counted.clear();
    began = performance.now() / 1000;
    state.state = "running";
    angle = await frames.run(angle, show);
  } catch (error) {
    state.state = "failed";
    fail(error);
  } finally {
    frames?.dispose();
    frames = undefined;
  }
}

function restart(hausdorff: Hausdorff): void {
  newest += 1;
  frames?.stop();
  if (state.state === "paused") return;
  const id = newest;
  running = running.then(() => run(hausdorff, id));
}

try {
  const hausdorff = await Hausdorff.create({ backend: "cpu" });
  pause.disabled = false;
  pause.addEventListener("click", () => {
    const pausing = state.state !== "paused";
    pause.textContent = pausing ? texts.experiments.continue : texts.experiments.pause;
    state.state = pausing ? "paused" : "starting";
    restart(hausdorff);
  });
  onSettings(() => restart(hausdorff));
  restart(hausdorff);
} catch (error) {
  state.state = "failed";
  fail(error);
}
