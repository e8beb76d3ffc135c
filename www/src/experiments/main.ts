// The page of experiments: runs the sweep that the form describes, and draws it.

import { element } from "../common/elements.ts";
import { engineText } from "../common/engineText.ts";
import { axisNumber } from "../common/plots/axisNumber.ts";
import { texts } from "../texts/index.ts";
import { Plots } from "./charts/plots.ts";
import * as form from "./form.ts";
import * as methodList from "./methodList.ts";
import { notesOf } from "./notes.ts";
import { Readout } from "./readout.ts";
import { Runs } from "./sweep/runs.ts";
import { Sweep } from "./sweep/sweep.ts";
import type { Curve, Failure } from "./sweep/sweepPoint.ts";
import { csv } from "./sweep/table.ts";

const runs = new Runs(
  ({ engine, shapes }) => {
    form.setShapeTitles(shapes);
    element("engine").textContent = engineText(engine);
    setState("ready", texts.experiments.states.ready);
  },
  (failure) => showFailure(failure),
);
const readout = new Readout();
const plots = new Plots(methodList.colorOf, (index) => readout.showPosition(index));
const [start, stop] = [element("run", HTMLButtonElement), element("stop", HTMLButtonElement)];
const save = element("save", HTMLButtonElement);
const progress = element("progress", HTMLProgressElement);
const error = element("error");

let sweep: Sweep | undefined;
let curves: readonly Curve[] = [];
let pairName = "";

form.fill();
element("panel").addEventListener("submit", (event) => {
  event.preventDefault();
  void run();
});
stop.addEventListener("click", () => {
  setState("stopping", texts.experiments.states.stopping);
  sweep?.stop();
});
save.addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([csv(curves)], { type: "text/csv" }));
  link.download = `sweep-${pairName}.csv`;
  link.click();
  URL.revokeObjectURL(link.href);
});

async function run(): Promise<void> {
  error.hidden = true;
  const plan = form.plan();
  const sources = form.sources();
  if (sources === undefined) {
    setState("ready", texts.experiments.openAFileAsA);
    return;
  }
  start.disabled = true;
  setState("loading", texts.experiments.loadingTheModels);
  const loaded = await runs.load(sources);
  if ("failure" in loaded) {
    showFailure(loaded.failure);
    return;
  }
  stop.disabled = false;
  pairName = plan.pair.name;
  sweep = new Sweep(runs, plan, loaded.value);
  const ended = await sweep.run({
    onBegin(positions, newCurves) {
      curves = newCurves;
      progress.max = positions.length * newCurves.length;
      progress.value = 0;
      save.disabled = false;
      for (const { name } of form.entries()) methodList.setNotes(name, []);
      element("plots").hidden = false;
      plots.show(positions, newCurves);
      readout.show(positions, newCurves);
    },
    onRun(position, { name }) {
      setState("running", texts.experiments.at(name, axisNumber(position)));
    },
    onPoint() {
      progress.value += 1;
      plots.update();
      readout.update();
      for (const curve of curves) methodList.setNotes(curve.method.name, notesOf(curve));
    },
  });
  setState(ended ? "done" : "stopped", texts.experiments.states[ended ? "done" : "stopped"]);
  start.disabled = false;
  stop.disabled = true;
}

/** Sets the state, which tests and other programs can read from the data attribute. */
function setState(state: string, text: string): void {
  element("sweep").dataset.state = state;
  element("status").textContent = text;
}

function showFailure({ code, message }: Failure): void {
  error.hidden = false;
  error.dataset.code = code;
  error.textContent = `${code}: ${message}`;
  setState("failed", texts.experiments.states.failed);
  start.disabled = false;
}
