// The page: panel to worker, worker to view and read-out.
import { Client } from "./client.ts";
import * as controls from "./controls.ts";
import { element } from "./elements.ts";
import * as notices from "./notices.ts";
import { Pose } from "./pose.ts";
import type { Reply } from "./protocol.ts";
import * as results from "./results.ts";
import { offer, onSource, tellLoading, tellSources } from "./sources.ts";
import { View } from "./view.ts";

const canvas = element("canvas", HTMLCanvasElement);
const view = new View(canvas, notices.tellNoWebGl);
const client = new Client(onReply);

element("panel").addEventListener("submit", (event) => event.preventDefault());
element("cancel").addEventListener("click", () => client.cancel());
element("fit").addEventListener("click", () => view.fit());
element("approach").addEventListener("click", () => view.approachArrow());
canvas.addEventListener("dblclick", () => view.fit());
controls.onChange(() => {
  results.hideError();
  measure();
});
onSource((sources, placement) => {
  results.hideError();
  tellLoading(true);
  client.load(sources, placement);
});

function measure(): void {
  if (!view.models.complete) return;
  const pose = new Pose(controls.moved(), controls.turned(), view.models.middle);
  view.show(pose, controls.wanted());
  results.showPending();
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
      tellLoading(false);
      view.hideResult();
      results.showNone("working");
      measure();
      view.fit();
      break;
    case "progress":
      results.showWorking(
        reply.fraction,
        reply.interval,
        view.models.diagonal,
        controls.options().symmetric === true,
      );
      break;
    case "measured":
      results.showResult(reply.result, client.isNewest(reply.run));
      view.showResult(reply.result, reply.transform);
      if (reply.result.notice !== undefined) notices.tellCpu(reply.result.notice);
      break;
    case "cancelled":
      if (!client.isNewest(reply.run)) break;
      results.showNone("cancelled");
      view.hideResult();
      break;
    case "failed":
      if (reply.run !== undefined && !client.isNewest(reply.run)) break;
      results.showError(reply.code, reply.message);
      if (reply.run === undefined) tellLoading(false);
      // A file that could not be read leaves the models and their result as they are.
      if (reply.run !== undefined || !view.models.complete) {
        results.showNone("failed");
        view.hideResult();
      }
      break;
  }
}
