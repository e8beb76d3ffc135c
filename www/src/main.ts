// The main page: connects the panel, the worker, the view and the results.
import type { Transform } from "nurbs-hausdorff";
import { element } from "./common/elements.ts";
import * as options from "./controls/options.ts";
import { fillShapes, onSource, setLoading, showSources } from "./controls/sources.ts";
import { FacesPanel } from "./faces/facesPanel.ts";
import { showFileNotes } from "./files/fileNotes.ts";
import * as resultPanel from "./results/resultPanel.ts";
import * as warnings from "./results/warnings.ts";
import { Pose } from "./scene/pose.ts";
import { View } from "./scene/view.ts";
import { Client } from "./worker/client.ts";
import type { Reply } from "./worker/protocol.ts";

const canvas = element("canvas", HTMLCanvasElement);
const view = new View(canvas, warnings.showNoWebGl);
const client = new Client(onReply);
const faces = new FacesPanel({
  compare: (tolerance) => client.diff({ tolerance, transform: transform() }),
  cancel: () => client.cancelDiff(),
  show: (result) => view.showFaces(result),
  select: (change) => view.selectFace(change),
});

element("panel").addEventListener("submit", (event) => event.preventDefault());
element("cancel").addEventListener("click", () => client.cancel());
element("fit").addEventListener("click", () => view.fit());
element("approach").addEventListener("click", () => view.approachArrow());
canvas.addEventListener("dblclick", () => view.fit());
options.onChange((moved) => {
  resultPanel.hideError();
  if (moved) outdateFaces();
  measure();
});
onSource((sources, placement) => {
  resultPanel.hideError();
  setLoading(true);
  client.load(sources, placement);
});

const pose = (): Pose =>
  new Pose(options.translation(), options.rotationDegrees(), view.models.middle);

const transform = (): Transform => pose().transform;

function measure(): void {
  if (!view.models.complete) return;
  view.show(pose(), options.overlays());
  resultPanel.showPending();
  client.measure({ ...options.distanceOptions(), transform: transform() });
}

/** Ends a comparison of faces whose positions are no longer those shown. */
function outdateFaces(): void {
  if (!faces.active) return;
  client.cancelDiff();
  faces.clear("outdated", "A was moved: compare again.");
}

function onReply(reply: Reply): void {
  switch (reply.kind) {
    case "ready":
      warnings.showEngine(reply.engine);
      fillShapes(reply.shapes);
      break;
    case "loading":
      setLoading(true, reply.text);
      break;
    case "loaded":
      faces.clear("idle", "");
      view.models.show(reply.models);
      faces.propose(view.models.diagonal);
      showSources(reply.models, reply.placement);
      showFileNotes(reply.models);
      options.setPlacement(reply.placement, view.models.diagonal);
      setLoading(false);
      view.hideResult();
      resultPanel.clearResult("working");
      measure();
      view.fit();
      break;
    case "progress":
      resultPanel.showWorking(
        reply.fraction,
        reply.interval,
        view.models.diagonal,
        options.distanceOptions().symmetric === true,
      );
      break;
    case "measured":
      resultPanel.showResult(reply.result, client.isNewest(reply.run));
      view.showResult(reply.result, reply.transform);
      warnings.showEngine(reply.engine);
      warnings.showResultNotice(reply.result.notice, reply.engine);
      break;
    case "diff":
      // A comparison that ended because A was moved is no longer shown.
      if (faces.active || reply.state === "working") faces.show(reply);
      break;
    case "cancelled":
      if (!client.isNewest(reply.run)) break;
      resultPanel.clearResult("cancelled");
      view.hideResult();
      break;
    case "failed":
      if (reply.run !== undefined && !client.isNewest(reply.run)) break;
      resultPanel.showError(reply.code, reply.message);
      if (reply.run === undefined) setLoading(false);
      // After a file that could not be loaded, the old models and their result stay.
      if (reply.run !== undefined || !view.models.complete) {
        resultPanel.clearResult("failed");
        view.hideResult();
      }
      break;
  }
}
