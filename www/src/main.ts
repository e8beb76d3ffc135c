// The page: panel to worker, worker to view and read-out.
import { Client } from "./client.ts";
import * as controls from "./controls.ts";
import { element } from "./elements.ts";
import * as notices from "./notices.ts";
import { Pose } from "./pose.ts";
import type { Reply } from "./protocol.ts";
import * as results from "./results.ts";
import { offer, onSource, tellSources } from "./sources.ts";
import { View } from "./view.ts";

const canvas = element("canvas", HTMLCanvasElement);
const view = new View(canvas, notices.tellNoWebGl);
const client = new Client(onReply);

element("panel").addEventListener("submit", (event) => event.preventDefault());
element("cancel").addEventListener("click", () => client.cancel());
element("fit").addEventListener("click", () => view.fit());
element("approach").addEventListener("click", () => view.approachArrow());
canvas.addEventListener("dblclick", () => view.fit());
controls.onChange(measure);
onSource((sources, placement) => {
  results.hideError();
  client.load(sources, placement);
});

function measure(): void {
  if (!view.models.complete) return;
  const pose = new Pose(controls.moved(), controls.turned(), view.models.middle);
  view.show(pose, controls.linesWanted(), controls.trianglesWanted());
  client.measure({ ...controls.options(), transform: pose.transform });
}

function onReply(reply: Reply): void {
  switch (reply.kind) {
    case "ready":
      notices.tellEngine(reply.backend, reply.adapter, reply.notice);
      offer(reply.shapes);
      break;
    case "loaded":
      view.models.show(reply.models);
      tellSources(reply.models, reply.placement);
      controls.place(reply.placement, view.models.diagonal);
      view.hideResult();
      measure();
      view.fit();
      break;
    case "progress":
      results.showWorking(reply.fraction, reply.interval);
      break;
    case "measured":
      results.showResult(reply.result, client.isNewest(reply.run));
      view.showResult(reply.result);
      if (reply.result.notice !== undefined) notices.tellCpu(reply.result.notice);
      break;
    case "cancelled":
      if (!client.isNewest(reply.run)) break;
      results.showNone("cancelled");
      view.hideResult();
      break;
    case "failed":
      results.showError(reply.code, reply.message);
      // A file that could not be read leaves the models and their result as they are.
      if (reply.run !== undefined) {
        results.showNone("failed");
        view.hideResult();
      }
      break;
  }
}
