// The page: controls to worker, worker to view and read-out.
import { Arrow } from "./arrow.ts";
import { Client } from "./client.ts";
import * as controls from "./controls.ts";
import { onFile } from "./drop.ts";
import { element } from "./elements.ts";
import { Models } from "./models.ts";
import { Pose } from "./pose.ts";
import { presets } from "./presets.ts";
import { ProjectionLines } from "./projection-lines.ts";
import type { Reply, Side } from "./protocol.ts";
import * as results from "./results.ts";
import { Viewport } from "./viewport.ts";

const canvas = element("canvas", HTMLCanvasElement);
const viewport = new Viewport(canvas);
const models = new Models();
const arrow = new Arrow(element("label"));
const lines = new ProjectionLines();
const client = new Client(onReply);
const preset = element("preset", HTMLSelectElement);

viewport.scene.add(models.group, arrow.group, lines.lines);
viewport.onDraw = () => arrow.place(viewport.camera, canvas.clientWidth, canvas.clientHeight);

presets.forEach(({ title }, index) => {
  preset.append(new Option(title, `${index}`));
});
preset.addEventListener("change", loadPreset);
element("cancel").addEventListener("click", () => client.cancel());
element("controls").addEventListener("submit", (event) => event.preventDefault());
controls.onChange(measure);
onFile((side, name, text) => {
  results.hideError();
  // Files are compared where they lie.
  controls.place([0, 0, 0], 0);
  client.load(side, { json: text, name });
});

function loadPreset(): void {
  const chosen = presets[Number(preset.value)];
  if (chosen === undefined) return;
  results.hideError();
  controls.place(chosen.move, chosen.turn ?? 0);
  client.load("a", { shape: chosen.a });
  client.load("b", { shape: chosen.b });
}

function measure(): void {
  if (!models.complete) return;
  const { diagonal } = models;
  const [x, y, z] = controls.moved();
  const pose = new Pose(
    controls.turned(),
    [x * diagonal, y * diagonal, z * diagonal],
    models.middle,
  );
  models.pose(pose);
  models.edges = controls.edgesWanted();
  viewport.draw();
  client.measure({ ...controls.options(), transform: pose.transform });
}

function onReply(reply: Reply): void {
  switch (reply.kind) {
    case "ready":
      tellEngine(reply.backend, reply.adapter, reply.notice);
      loadPreset();
      break;
    case "loaded":
      models.show(reply.side, reply.shown);
      tellName(reply.side, `${reply.shown.name} · ${reply.shown.surfaceCount}`);
      arrow.hide();
      lines.hide();
      viewport.fit(0.5 * models.diagonal);
      measure();
      break;
    case "progress":
      results.showWorking(reply.fraction, reply.interval);
      break;
    case "measured": {
      const { result } = reply;
      results.showResult(result);
      arrow.show(result, models.center);
      const field = result.field ?? result.forward?.field;
      if (controls.linesWanted() && field) lines.show(field, models.center);
      else lines.hide();
      viewport.draw();
      break;
    }
    case "cancelled":
      results.showCancelled();
      break;
    case "failed":
      results.showError(reply.code, reply.message);
      break;
  }
}

function tellEngine(backend: "gpu" | "cpu", adapter: string | null, notice: string | null): void {
  element("engine").textContent =
    backend === "gpu"
      ? `WebGPU${adapter ? `: ${adapter}` : ""} · certificates in float64`
      : "CPU, float64";
  const banner = element("banner");
  banner.hidden = notice === null;
  banner.textContent = "No WebGPU here, so everything runs on the CPU.";
  banner.title = notice ?? "";
}

function tellName(side: Side, text: string): void {
  element(`name-${side}`).textContent = text;
}
