// The page of experiments: the panel's choice swept, drawn as it runs.
import "uplot/dist/uPlot.min.css";
import { element } from "../elements.ts";
import { engineText } from "../engine-text.ts";
import { axisNumber } from "./axis-number.ts";
import * as choice from "./choice.ts";
import * as methodList from "./method-list.ts";
import { notesOf } from "./notes.ts";
import type { Curve, Failure } from "./outcome.ts";
import { Plots } from "./plots.ts";
import { Reading } from "./reading.ts";
import { Runs } from "./runs.ts";
import { Sweep } from "./sweep.ts";
import { csv } from "./table.ts";

const runs = new Runs(
  ({ backend, adapter, shapes }) => {
    choice.nameShapes(shapes);
    element("engine").textContent = engineText(backend, adapter);
    tellState("ready", "ready");
  },
  (failure) => tellFailure(failure),
);
const reading = new Reading();
const plots = new Plots((index) => reading.at(index));
const [start, stop] = [element("run", HTMLButtonElement), element("stop", HTMLButtonElement)];
const save = element("save", HTMLButtonElement);
const progress = element("progress", HTMLProgressElement);
const error = element("error");

let sweep: Sweep | undefined;
let curves: readonly Curve[] = [];
let swept = "";

choice.offer();
element("panel").addEventListener("submit", (event) => {
  event.preventDefault();
  void run();
});
stop.addEventListener("click", () => {
  tellState("stopping", "stopping");
  sweep?.stop();
});
save.addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([csv(curves)], { type: "text/csv" }));
  link.download = `sweep-${swept}.csv`;
  link.click();
  URL.revokeObjectURL(link.href);
});

async function run(): Promise<void> {
  error.hidden = true;
  const plan = choice.plan();
  const sources = choice.sources();
  if (sources === undefined) {
    tellState("ready", "Open a file as A or B first.");
    return;
  }
  start.disabled = true;
  tellState("loading", "loading the models");
  const loaded = await runs.load(sources);
  if ("failure" in loaded) {
    tellFailure(loaded.failure);
    return;
  }
  stop.disabled = false;
  swept = plan.pair.name;
  sweep = new Sweep(runs, plan, loaded.value);
  const ended = await sweep.run({
    onBegin(positions, begun) {
      curves = begun;
      progress.max = positions.length * begun.length;
      progress.value = 0;
      save.disabled = false;
      for (const { name } of choice.entries()) methodList.tell(name, []);
      element("plots").hidden = false;
      plots.show(positions, begun);
      reading.show(positions, begun);
    },
    onRun(position, { name }) {
      tellState("running", `${name} at ${axisNumber(position)}`);
    },
    onOutcome() {
      progress.value += 1;
      plots.update();
      reading.follow();
      for (const curve of curves) methodList.tell(curve.method.name, notesOf(curve));
    },
  });
  tellState(ended ? "done" : "stopped", ended ? "done" : "stopped");
  start.disabled = false;
  stop.disabled = true;
}

/** What tests and other programs may read is in the data attribute. */
function tellState(state: string, text: string): void {
  element("sweep").dataset.state = state;
  element("status").textContent = text;
}

function tellFailure({ code, message }: Failure): void {
  error.hidden = false;
  error.dataset.code = code;
  error.textContent = `${code}: ${message}`;
  tellState("failed", "failed");
  start.disabled = false;
}
