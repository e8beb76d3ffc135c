// The main page: makes its parts and connects the panel, the worker, the view and the results.
import { AlignmentByPicks } from "./alignment/byPicks.ts";
import { AnnotationLayer } from "./annotations/layer.ts";
import { AnnotationList } from "./annotations/list.ts";
import { annotationTool } from "./annotations/tool.ts";
import { connect } from "./app/controls.ts";
import { Measurement } from "./app/measurement.ts";
import { Opening } from "./app/opening.ts";
import type { Parts } from "./app/parts.ts";
import { Replies } from "./app/replies.ts";
import { CheckPanel } from "./check/checkPanel.ts";
import { showBodies } from "./check/shown.ts";
import { ClearancePanel } from "./clearance/clearancePanel.ts";
import { element } from "./common/elements.ts";
import { nextTask } from "./common/nextTask.ts";
import { connectNumberFields } from "./controls/numberFields.ts";
import { setPosition } from "./controls/position.ts";
import { Views } from "./export/views.ts";
import { FacesPanel } from "./faces/facesPanel.ts";
import { FaceTree } from "./faces/faceTree.ts";
import { FactsPanel } from "./facts/factsPanel.ts";
import { OverlapPanel } from "./facts/overlapPanel.ts";
import type { Take } from "./inspection/pickingTool.ts";
import { Probing } from "./inspection/pins/probing.ts";
import { PlaceView } from "./inspection/places/placeView.ts";
import { MeasureList } from "./measuring/list.ts";
import { Measuring } from "./measuring/tool.ts";
import * as warnings from "./results/warnings.ts";
import { degreesOf } from "./scene/pose.ts";
import { History } from "./state/history.ts";
import { Client } from "./worker/client.ts";

const canvas = element("canvas", HTMLCanvasElement);
// The worker starts first; its replies wait until the page is complete.
let complete: (replies: Replies) => void = () => {};
const whenComplete = new Promise<Replies>((resolve) => {
  complete = resolve;
});
const client = new Client((reply) => void whenComplete.then((replies) => replies.take(reply)));
await nextTask();
// The view's code and its drawing are tasks of their own.
const { View } = await import("./scene/view.ts");
await nextTask();
const view = await View.open(canvas, warnings.showNoWebGl, warnings.showContext, (move, rotation) =>
  setPosition(move, degreesOf(rotation)),
);
const faces = new FacesPanel({
  compare: (limit) => {
    check.unshow();
    client.diff(measurement.diffOptions(limit));
  },
  cancel: () => client.cancelDiff(),
  show: (result, side) => view.showFaces(result, side),
  select: (change) => view.selectFace(change),
  mark: (parts) => tree.markParts(parts),
  look: (part) => {
    tree.isolate(part?.facesOf);
    if (part === undefined) view.back();
    else view.approachFaces(part.facesOf);
  },
});
const tree = new FaceTree({
  hide: (side, hidden) => view.hideFaces(side, hidden),
  look: (side, faces) => view.approachFaces({ [side]: faces }),
});
const probing = new Probing(canvas, view, client, () => measurement.pose().transform);
const take: Take = (click) => {
  probing.nextClick = click;
};
const measuring = new Measuring(view, take);
const measureList = new MeasureList(view);
const labels = new AnnotationLayer(() => view.redraw());
view.follow((viewport) => labels.update(viewport, view.models));
const annotating = annotationTool({
  hit: (x, y) => view.hit(x, y),
  take,
  begin: ({ side, face, near }) => labels.begin({ side, face, point: near }),
});
const aligning = new AlignmentByPicks({
  hit: (x, y) => {
    const hit = view.hit(x, y);
    return hit && { side: hit.side, face: hit.face, point: hit.near };
  },
  take,
  onPlace: () => view.onPlace(),
  lay: (start) => measurement.fit(start),
  scale: () => view.models.scale,
  redraw: () => view.redraw(),
});
view.follow((viewport) => aligning.update(viewport, view.models));
const annotationList = new AnnotationList({
  look: ({ side, face, point }) => view.approachPoint(side, face, point),
  edit: (index) => labels.edit(index),
  nameOf: (side, face) => view.models.drawn[side]?.faceNames[face] ?? `${face}`,
});
const clearance = new ClearancePanel({
  change: () => measurement.turn(),
  select: ({ witness: { a, b } }) =>
    view.approach(a.point, b.point, { length: "", from: "A", to: "B" }),
});
const facts = new FactsPanel(() => client.facts());
const overlap = new OverlapPanel({
  measure: (maxSeconds) => measurement.overlap(maxSeconds),
  cancel: () => client.cancelOverlap(),
});
const check = new CheckPanel({
  check: (of, below) => measurement.check(of, below),
  cancel: () => client.cancelCheck(),
  show: (shown) => {
    if (shown !== undefined) {
      // These have colours of their own.
      clearance.end();
      if (faces.active) faces.clear("idle", "");
    }
    showBodies({ view, tree }, shown, measurement.pose().transform);
  },
});
const parts: Parts = {
  ...{
    client,
    view,
    faces,
    tree,
    probing,
    measuring,
    annotating,
    annotationList,
    aligning,
    measureList,
  },
  ...{ clearance, facts, overlap, check },
  places: new PlaceView(view, probing, tree, () => clearance.active),
  views: new Views(view, canvas, () => labels.drawn),
  past: new History((state) => opening.restore(state)),
};
const measurement = new Measurement(parts);
const opening = new Opening(parts, measurement);
connectNumberFields();
connect(parts, measurement, opening);
complete(new Replies(parts, measurement, opening));
