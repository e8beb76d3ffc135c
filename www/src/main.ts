// The main page: connects the panel, the worker, the view and the results.
import { ClearancePanel } from "./clearance/clearancePanel.ts";
import { showMeeting } from "./clearance/meeting.ts";
import { element } from "./common/elements.ts";
import { nextTask } from "./common/nextTask.ts";
import { clearFit, isFitting, onFit, showFit } from "./controls/bestFit.ts";
import * as display from "./controls/display.ts";
import * as options from "./controls/options.ts";
import * as position from "./controls/position.ts";
import { IN_PLACE, presets } from "./controls/presets.ts";
import * as sections from "./controls/section.ts";
import {
  asideSide,
  fillShapes,
  leaveAside,
  onSource,
  openShapes,
  setLoading,
  showNames,
  showReading,
  showSources,
  sourcesOf,
} from "./controls/sources.ts";
import { visibilities } from "./controls/visibilities.ts";
import { download } from "./export/download.ts";
import { onExport } from "./export/exportPanel.ts";
import { exportAs } from "./export/exports.ts";
import { Views } from "./export/views.ts";
import { FacesPanel } from "./faces/facesPanel.ts";
import { FaceTree } from "./faces/faceTree.ts";
import { AskedFiles } from "./files/asked.ts";
import { showFileNotes } from "./files/fileNotes.ts";
import { type FileName, filesNamedBy, nameOf, parametersOf } from "./files/identity.ts";
import { forgetFiles, keepFiles, keepLast, keptFiles, lastFiles } from "./files/kept.ts";
import { onUnit, showUnits, unitScale } from "./files/units.ts";
import { drawCut } from "./inspection/cutView.ts";
import * as deviation from "./inspection/deviationPanel.ts";
import { Probing } from "./inspection/pins/probing.ts";
import { PlaceView } from "./inspection/placeView.ts";
import { clearOwnLimits, ownLimits } from "./results/ownLimits.ts";
import * as resultPanel from "./results/resultPanel.ts";
import { allowed, needsPrecision, onLimit } from "./results/verdict.ts";
import * as warnings from "./results/warnings.ts";
import { degreesOf, Pose } from "./scene/pose.ts";
import { applyFormState, formState } from "./state/formState.ts";
import { History } from "./state/history.ts";
import { Client } from "./worker/client.ts";
import {
  type BoundReply,
  type FitReply,
  type Placement,
  type PlainDiffOptions,
  type PlainOptions,
  type Reply,
  SIDES,
  type Sides,
  type Source,
} from "./worker/protocol.ts";

/** The finest tolerance, in diagonals, and the factor to it from one that does not decide. */
const FINEST = 1e-9;
const FINER = 30;

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
const view = await View.open(
  canvas,
  warnings.showNoWebGl,
  warnings.showContext,
  (move, rotation) => {
    position.setPosition(move, degreesOf(rotation));
    moved();
  },
);
const faces = new FacesPanel({
  compare: (limit) => client.diff(diffOptions(limit)),
  cancel: () => client.cancelDiff(),
  show: (result, side) => view.showFaces(result, side),
  select: (change) => view.selectFace(change),
});
const tree = new FaceTree({
  hide: (side, hidden) => view.hideFaces(side, hidden),
  look: (side, faces) => view.approachFaces(side, faces),
});
const probing = new Probing(canvas, view, client, () => pose().transform);
const places = new PlaceView(view, probing, tree);
const views = new Views(view, canvas);
const clearance = new ClearancePanel({
  change: () => {
    if (!clearance.active) {
      client.cancelClearance();
      showMeeting(view, undefined);
    }
    measure();
  },
  select: ({ witness: { a, b } }) =>
    view.approach(a.point, b.point, { length: "", from: "A", to: "B" }),
});
/** Controls that are set only after the models of their state are loaded. */
let pending: string | undefined;
/** The tolerance of a measurement that the user's precision did not decide. */
let finer: number | undefined;
/** The run whose colours are shown, once they are as fine as they get. */
let colored: number | undefined;
let started = false;
const past = new History((state) => {
  if (openShapes(state)) pending = state;
  else applyFormState(state);
});
/** The files compared, as links name them. */
let named: Sides<FileName> = {};
past.onState = (state) => {
  if (Object.keys(named).length > 0) void keepLast(named, state);
};
const asked = new AskedFiles(() => openShapes());
/** The state of the link whose files are asked for. */
let linkedState: string | undefined;

element("panel").addEventListener("submit", (event) => event.preventDefault());
element("cancel").addEventListener("click", () => client.cancel());
element("load-cancel").addEventListener("click", stopLoading);
element("fit").addEventListener("click", () => view.fit());
element("approach").addEventListener("click", () => view.approachArrow());
element("add-view").addEventListener("click", () => views.add());
element("forget").addEventListener("click", () => {
  named = {};
  past.files = "";
  void forgetFiles();
  element("kept").hidden = true;
});
element("sheet").addEventListener("click", () => {
  const open = element("panel").classList.toggle("open");
  element("sheet").setAttribute("aria-expanded", `${open}`);
  element("sheet").textContent = open ? "Show the parts" : "Show all";
});
canvas.addEventListener("dblclick", () => view.fit());
document.addEventListener("input", () => past.record());
view.onCamera((place) => {
  past.camera = place;
});
display.onDisplay((name) => view.look(name), show);
sections.onSection(
  {
    models: view.models,
    seen: () => view.seen,
    onNextFace: (callback) => {
      probing.nextClick = callback && ((x, y) => callback(view.facing(x, y)));
    },
  },
  show,
);
// What Escape ends first, as the choice of a face to cut by, has prevented this.
window.addEventListener("keydown", ({ key, defaultPrevented }) => {
  if (key === "Escape" && !defaultPrevented) view.back();
});
deviation.onScale(paint);
onLimit(() => {
  deviation.rescale();
  places.show();
  refine();
  boundFaces();
});
options.onChange(() => {
  resultPanel.hideError();
  finer = undefined;
  measure();
});
position.onPosition(moved);
onFit(
  () => client.fit({ transform: pose().transform, scaleUnits: true }),
  () => client.cancelFit(),
);
onUnit((side, unit) => {
  const source = view.models.drawn[side]?.source;
  if (source === undefined || !("file" in source) || source.unit === unit) return;
  const { unit: _before, ...rest } = source;
  // The file is read again; all else stays.
  pending = formState();
  read({ [side]: unit === undefined ? rest : { ...rest, unit } }, IN_PLACE);
});
onSource(({ sources, placement, files }) => {
  resultPanel.hideError();
  if (asked.isActive && files.length > 0) {
    void asked.take(files).then((all) => {
      if (all === undefined) return;
      leaveAside(undefined);
      pending = linkedState;
      read(all, IN_PLACE);
    });
    return;
  }
  // What was asked for is no longer wanted; the page always has two models.
  if (asked.isActive) {
    asked.end();
    const [example] = presets;
    const others = example && { a: { shape: example.a }, b: { shape: example.b } };
    read({ ...others, ...sources }, placement);
  } else read(sources, placement);
});
onExport((format) =>
  exportAs(format, {
    ...{ view, views, options: measured(), diff: faces.result, pins: view.pins.probes },
    ...{ result: view.result, models: view.models.drawn, requestCsv: () => client.csv() },
    places: places.all,
  }),
);

complete();

function read(sources: Sides<Source>, placement: Placement): void {
  setLoading(true);
  showReading(sources);
  view.models.clearDrafts();
  client.load(sources, placement);
}

/** Draws maps in their colours. */
function paint({ scale, maps, largest, isSame }: deviation.Painting): void {
  if (isSame) {
    view.rescale(scale);
    return;
  }
  view.showMaps(maps, scale, largest);
  show();
}

function pose(): Pose {
  return new Pose(position.translation(), position.degrees(), view.models.middle);
}

function diffOptions(limit: number): PlainDiffOptions {
  return {
    ...{ limit, transform: pose().transform, scaleUnits: true },
    own: ownLimits().map(({ side, face, above, below }) => ({
      ...{ side, face, limit: Math.min(above, below) },
    })),
  };
}

function measured(): PlainOptions {
  return {
    ...options.distanceOptions(),
    ...(finer !== undefined && { relativeTolerance: finer }),
    transform: pose().transform,
    scaleUnits: true,
  };
}

function moved(): void {
  resultPanel.hideError();
  if (isFitting()) client.cancelFit();
  clearFit();
  probing.clear();
  finer = undefined;
  if (faces.active) {
    client.cancelDiff();
    faces.clear("outdated", "A was moved: compare again.");
  }
  past.record();
  measure();
}

function show(): void {
  view.show(pose(), options.overlays(), {
    visibility: visibilities(view.models, view.result, deviation.paintedSides()),
    orthographic: display.isOrthographic(),
    section: sections.section(),
    gizmo: display.gizmoMode(),
    wipe: display.wipe(),
    fileColors: display.hasFileColors(),
  });
  sections.showOffset(view.models);
  drawCut(view.models);
}

function measure(): void {
  client.cancelBound();
  delete element("points").dataset.bounded;
  if (view.models.aside !== undefined) {
    client.cancel();
    resultPanel.clearResult("lone");
    hideResult();
    show();
  }
  if (!view.models.complete) return;
  if (clearance.active) {
    // The deviation shown is no longer that of the models as they are.
    client.cancel();
    resultPanel.clearResult("paused");
    hideResult();
    show();
    clearance.showPending();
    const { transform } = pose();
    client.clearance({ below: clearance.below, transform, scaleUnits: true });
    return;
  }
  show();
  resultPanel.showPending();
  client.measure(measured(), options.paint());
}

/** Measures again with a finer tolerance where the verdict needs it, down to what float64 has. */
function refine(): void {
  const { result } = view;
  if (result?.method !== "certified" || !result.converged || !needsPrecision()) return;
  const now = finer ?? options.distanceOptions().relativeTolerance ?? FINEST;
  const reached = (result.upper - result.lower) / result.diagonal;
  // An interval that is narrow enough for the finest tolerance is the one that it would give.
  if (now <= FINEST || reached <= FINEST) return;
  finer = Math.max(FINEST, now / FINER);
  measure();
}

function stopLoading(): void {
  // The models before keep their position and options.
  pending = formState();
  client.stopLoading(IN_PLACE);
  setLoading(view.models.complete);
  showBefore();
}

/** Draws the models again whose replacement was drawn in part; returns whether there was any. */
function showBefore(): boolean {
  if (!view.dropDrafts() || !view.models.complete) return false;
  show();
  view.fit(true);
  return true;
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

/** Shows faces of a file as they are read; the result is that of models which are no longer drawn. */
function showDraft({ side, replaced, draft }: Extract<Reply, { kind: "draft" }>): void {
  setLoading(true, `reading… ${Math.floor(100 * draft.fraction)} %`);
  if (!view.isDrafting) {
    probing.clear();
    hideResult();
    resultPanel.clearResult("working");
  }
  view.showDraft(side, replaced, draft);
}

function showLoaded({ models, placement }: Extract<Reply, { kind: "loaded" }>): void {
  faces.clear("idle", "");
  probing.clear();
  views.clear();
  clearFit();
  finer = undefined;
  view.showModels(models);
  showSources(models, placement);
  view.models.aside = asideSide();
  showFileNotes(models);
  showUnits(models);
  view.models.scale = unitScale();
  tree.show(view.models.drawn);
  display.offerFileColors(view.models.hasFileColors);
  faces.propose(view.models.diagonal);
  position.setPlacement(placement, view.models.diagonal);
  void keep();
  clearOwnLimits();
  const state = pending;
  pending = undefined;
  if (state !== undefined) applyFormState(state, ["a", "b"]);
  setLoading(false);
  hideResult();
  resultPanel.clearResult("working");
  measure();
  view.fit(true);
  const camera = History.cameraOf(state);
  if (camera !== undefined) view.camera = camera;
  const { drawn } = view.models;
  const fromFile = SIDES.some((side) => "file" in (drawn[side]?.source ?? {}));
  past.ofFiles = fromFile;
  if (fromFile) past.reset();
  else past.record();
}

/** Names the files compared in the address, and keeps them over a reload. */
async function keep(): Promise<void> {
  const { drawn } = view.models;
  const files: Sides<FileName & { file: File }> = {};
  for (const side of SIDES) {
    const source = drawn[side]?.source;
    if (source === undefined || !("file" in source)) continue;
    const { file } = source;
    files[side] = { ...(await nameOf(file)), file };
  }
  // Others were opened while the hashes were computed.
  if (SIDES.some((side) => drawn[side] !== view.models.drawn[side])) return;
  named = Object.fromEntries(
    Object.entries(files).map(([side, { name, hash }]) => [side, { name, hash }]),
  );
  element("kept").hidden = Object.keys(files).length === 0;
  past.files = parametersOf(named);
  await keepFiles(files);
}

function hideResult(): void {
  view.hideResult();
  deviation.hideMaps();
  places.show();
  drawCut(view.models);
}

function showMeasured({ run, result, maps, pending }: Extract<Reply, { kind: "measured" }>): void {
  // The colours before stay until new ones replace them.
  const hasMaps = Object.keys(maps).length > 0;
  const replaced = hasMaps || !pending;
  view.showResult(result, replaced);
  if (replaced) deviation.hideMaps();
  const painting = hasMaps ? deviation.showMaps(result, maps) : undefined;
  if (painting !== undefined) paint(painting);
  else show();
  if (!replaced) return;
  places.show();
  drawCut(view.models);
  colored = pending ? undefined : run;
  boundFaces();
}

/** Asks what is certain of each face, for what is allowed now, once the colours are there. */
function boundFaces(): void {
  const limits = allowed();
  client.cancelBound();
  if (colored === undefined || !client.isNewest(colored) || limits === undefined) return;
  const limit = Math.min(limits.above, limits.below);
  if (!(limit > 0) || deviation.painted() === undefined) return;
  client.bound(colored, diffOptions(limit));
}

function showBounds(reply: BoundReply): void {
  if (reply.state !== "done" || !client.isNewest(reply.run) || reply.run !== colored) return;
  deviation.bound(reply.result);
  places.show();
  element("points").dataset.bounded = `${reply.result.limit}`;
}

/** Opens what the page begins with: the address's shapes, the files that are kept, or the example. */
async function openFirst(): Promise<void> {
  const { linked } = History;
  const wanted = filesNamedBy(linked);
  if (linked !== undefined && Object.keys(wanted).length > 0) {
    await openNamed(wanted, linked);
    return;
  }
  const parameters = new URLSearchParams(linked);
  if (!parameters.has("a") && !parameters.has("b")) {
    const last = await lastFiles();
    const kept = await keptFiles(last.files);
    const count = Object.keys(kept).length;
    if (count > 0 && count === Object.keys(last.files).length) {
      await openNamed(last.files, last.state);
      return;
    }
  }
  if (linked !== undefined && openShapes(linked)) pending = linked;
  else openShapes();
}

/** Opens the files that a state is about; asks for those that are not kept here. */
async function openNamed(wanted: Sides<FileName>, state: string): Promise<void> {
  const kept = await keptFiles(wanted);
  const sources = sourcesOf(kept);
  const parameters = new URLSearchParams(state);
  for (const side of SIDES) {
    const shape = parameters.get(side);
    if (wanted[side] === undefined && shape !== null) sources[side] = { shape };
  }
  // A single file was compared with nothing.
  const alone = SIDES.find((side) => wanted[side] === undefined && sources[side] === undefined);
  if (alone !== undefined) {
    leaveAside(alone);
    sources[alone] = { shape: presets[0]?.[alone] ?? "" };
  }
  if (SIDES.every((side) => sources[side] !== undefined)) {
    pending = state;
    read(sources, IN_PLACE);
    return;
  }
  linkedState = state;
  asked.ask(wanted, sources);
  resultPanel.clearResult("asked");
}

function onReply(reply: Reply): void {
  // A run's replies are dropped while its models are not drawn, or their clearance is measured
  // instead. Distances are measured again afterwards.
  const isUnwanted = view.isDrafting || clearance.active;
  if (isUnwanted && "run" in reply && reply.run !== undefined) return;
  switch (reply.kind) {
    case "ready":
      warnings.showEngine(reply.engine);
      // A worker that replaces another loads the models of that one.
      if (started) break;
      started = true;
      fillShapes(reply.shapes);
      void openFirst();
      break;
    case "loading":
      setLoading(true, reply.text);
      break;
    case "draft":
      showDraft(reply);
      break;
    case "loaded":
      showLoaded(reply);
      break;
    case "restored":
      // What the worker before computed has no end.
      if (isFitting()) clearFit();
      faces.end();
      measure();
      break;
    case "closed":
      view.close(reply.side);
      show();
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
      // Before the colours are computed, which those of the finer measurement would replace.
      if (client.isNewest(reply.run)) refine();
      break;
    case "clearance":
      if (clearance.active) showMeeting(view, clearance.show(reply));
      break;
    case "diff":
      // A comparison that ended because A was moved is no longer shown.
      if (faces.active || reply.state === "working") faces.show(reply);
      break;
    case "bound":
      showBounds(reply);
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
      if (reply.run === undefined) {
        setLoading(false);
        showNames(view.models.drawn);
        if (showBefore()) measure();
      }
      // After a file that could not be loaded, the old models and their result stay.
      if (reply.run !== undefined || !view.models.complete) {
        resultPanel.clearResult("failed");
        hideResult();
      }
      break;
  }
}
