// The main page: connects the panel, the worker, the view and the results.
import { element } from "./common/elements.ts";
import { nextTask } from "./common/nextTask.ts";
import { clearFit, isFitting, onFit, showFit } from "./controls/bestFit.ts";
import * as display from "./controls/display.ts";
import * as options from "./controls/options.ts";
import * as position from "./controls/position.ts";
import { fillShapes, onSource, openShapes, setLoading, showSources } from "./controls/sources.ts";
import { download } from "./export/download.ts";
import { onExport } from "./export/exportPanel.ts";
import { exportAs } from "./export/exports.ts";
import { FacesPanel } from "./faces/facesPanel.ts";
import { onScaleUnits, scalesUnits, showFileNotes, unitScale } from "./files/fileNotes.ts";
import * as deviation from "./inspection/deviationPanel.ts";
import { Probing } from "./inspection/pins/probing.ts";
import * as resultPanel from "./results/resultPanel.ts";
import { onLimit } from "./results/verdict.ts";
import * as warnings from "./results/warnings.ts";
import { degreesOf, Pose } from "./scene/pose.ts";
import { applyFormState } from "./state/formState.ts";
import { History } from "./state/history.ts";
import { Client } from "./worker/client.ts";
import type { FitReply, PlainOptions, Reply } from "./worker/protocol.ts";

const canvas = element("canvas", HTMLCanvasElement);
// The worker starts first; its replies wait until the page is complete.
let complete: () => void = () => {};
const whenComplete = new Promise<void>((resolve) => {
  complete = resolve;
});
const client = new Client((reply) => void whenComplete.then(() => onReply(reply)));
await nextTask();
// The view's code and its drawing are tasks of their own.
const { View } = await import("./scene/view.ts");
await nextTask();
const view = await View.open(canvas, warnings.showNoWebGl, (move, rotation) => {
  position.setPosition(move, degreesOf(rotation));
  moved();
});
const faces = new FacesPanel({
  compare: (limit) =>
    client.diff({ limit, transform: pose().transform, scaleUnits: scalesUnits() }),
  cancel: () => client.cancelDiff(),
  show: (result) => view.showFaces(result),
  select: (change) => view.selectFace(change),
});
const probing = new Probing(canvas, view, client, () => pose().transform);
/** Controls that are set only after the models of their state are loaded. */
let pending: string | undefined;
const past = new History((state) => {
  if (openShapes(state)) pending = state;
  else applyFormState(state);
});

element("panel").addEventListener("submit", (event) => event.preventDefault());
element("cancel").addEventListener("click", () => client.cancel());
element("fit").addEventListener("click", () => view.fit());
element("approach").addEventListener("click", () => view.approachArrow());
canvas.addEventListener("dblclick", () => view.fit());
document.addEventListener("input", () => past.record());
display.onDisplay((name) => view.look(name), show);
deviation.onScale((scale) => view.rescale(scale));
onLimit(() => deviation.rescale());
options.onChange(() => {
  resultPanel.hideError();
  measure();
});
position.onPosition(moved);
onFit(
  () => client.fit({ transform: pose().transform, scaleUnits: scalesUnits() }),
  () => client.cancelFit(),
);
onScaleUnits(() => {
  view.models.scale = unitScale();
  moved();
  view.fit();
});
onSource((sources, placement) => {
  resultPanel.hideError();
  setLoading(true);
  client.load(sources, placement);
});
onExport((format) =>
  exportAs(format, {
    ...{ view, canvas, options: measured(), diff: faces.result, pins: view.pins.probes },
    ...{ result: view.result, names: view.models.names, requestCsv: () => client.csv() },
  }),
);

complete();

function pose(): Pose {
  return new Pose(position.translation(), position.degrees(), view.models.middle);
}

function measured(): PlainOptions {
  return {
    ...options.distanceOptions(),
    transform: pose().transform,
    scaleUnits: scalesUnits(),
  };
}

function moved(): void {
  resultPanel.hideError();
  if (isFitting()) client.cancelFit();
  clearFit();
  probing.clear();
  if (faces.active) {
    client.cancelDiff();
    faces.clear("outdated", "A was moved: compare again.");
  }
  past.record();
  measure();
}

function show(): void {
  const overlays = options.overlays();
  const a = display.visibility("a");
  view.show(pose(), overlays, {
    // Lines inside A are seen through it.
    visibility: {
      a: a === "solid" && overlays.lines ? "glass" : a,
      b: display.visibility("b"),
    },
    orthographic: display.isOrthographic(),
    section: display.section(),
    gizmo: display.gizmoMode(),
  });
}

function measure(): void {
  if (!view.models.complete) return;
  show();
  resultPanel.showPending();
  client.measure(measured());
}

function showFitted(reply: FitReply): void {
  // A fit that ended because A was moved is no longer shown.
  if (!isFitting()) return;
  if (reply.state === "done") {
    const { move, rotation } = Pose.of(reply.fit.transform, view.models.middle);
    clearFit();
    position.setComputedPosition(move, degreesOf(rotation));
    moved();
  } else if (reply.state === "failed") resultPanel.showError(reply.code, reply.message);
  showFit(reply, view.models.diagonal);
}

function showLoaded({ models, placement }: Extract<Reply, { kind: "loaded" }>): void {
  faces.clear("idle", "");
  probing.clear();
  clearFit();
  view.showModels(models);
  showSources(models, placement);
  showFileNotes(models);
  view.models.scale = unitScale();
  faces.propose(view.models.diagonal);
  position.setPlacement(placement, view.models.diagonal);
  if (pending !== undefined) applyFormState(pending, ["a", "b"]);
  pending = undefined;
  setLoading(false);
  hideResult();
  resultPanel.clearResult("working");
  measure();
  view.fit();
  const fromFile = Object.values(models).some(({ source }) => "file" in source);
  past.ofFiles = fromFile;
  if (fromFile) past.reset();
  else past.record();
}

function hideResult(): void {
  view.hideResult();
  deviation.hideDeviation();
}

function showMeasured({ result, field, pending }: Extract<Reply, { kind: "measured" }>): void {
  // The colours before stay until new ones replace them.
  const replaced = field !== undefined || !pending;
  view.showResult(result, replaced);
  if (replaced) deviation.hideDeviation();
  if (field === undefined) return;
  const { scale, largest } = deviation.showDeviation(result, field);
  view.showField(field, scale, largest);
}

function onReply(reply: Reply): void {
  switch (reply.kind) {
    case "ready": {
      warnings.showEngine(reply.engine);
      const { linked } = History;
      fillShapes(reply.shapes);
      if (linked !== undefined && openShapes(linked)) pending = linked;
      else openShapes();
      break;
    }
    case "loading":
      setLoading(true, reply.text);
      break;
    case "loaded":
      showLoaded(reply);
      break;
    case "progress":
      resultPanel.showWorking(reply.fraction, reply.interval, view.models.diagonal, {
        symmetric: options.distanceOptions().symmetric === true,
        stalled: reply.stalled,
      });
      break;
    case "measured":
      resultPanel.showResult(reply.result, {
        last: client.isNewest(reply.run),
        pending: reply.pending,
      });
      showMeasured(reply);
      warnings.showEngine(reply.engine);
      warnings.showResultNotice(reply.result.notice, reply.engine);
      break;
    case "diff":
      // A comparison that ended because A was moved is no longer shown.
      if (faces.active || reply.state === "working") faces.show(reply);
      break;
    case "fit":
      showFitted(reply);
      break;
    case "probed":
      probing.show(reply.id, reply.probe);
      break;
    case "csv":
      download("hausdorff.csv", reply.table);
      break;
    case "cancelled":
      if (!client.isNewest(reply.run)) break;
      resultPanel.clearResult("cancelled");
      if (reply.interval !== undefined) {
        resultPanel.showReached(reply.interval, view.models.diagonal);
      }
      hideResult();
      break;
    case "failed":
      if (reply.run !== undefined && !client.isNewest(reply.run)) break;
      resultPanel.showError(reply.code, reply.message);
      if (reply.run === undefined) setLoading(false);
      // After a file that could not be loaded, the old models and their result stay.
      if (reply.run !== undefined || !view.models.complete) {
        resultPanel.clearResult("failed");
        hideResult();
      }
      break;
  }
}
