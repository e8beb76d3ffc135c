// What the page does with the worker's replies.
import { showMeeting } from "../clearance/meeting.ts";
import { clearFit, isFitting, showFit } from "../controls/bestFit.ts";
import { setBodies } from "../controls/explode.ts";
import { distanceOptions } from "../controls/options.ts";
import { setComputedPosition } from "../controls/position.ts";
import { fillShapes, setLoading, showNames } from "../controls/sources.ts";
import { download } from "../export/download.ts";
import * as resultPanel from "../results/resultPanel.ts";
import * as warnings from "../results/warnings.ts";
import { degreesOf, Pose } from "../scene/pose.ts";
import type { FitReply, Reply } from "../worker/protocol.ts";
import type { Measurement } from "./measurement.ts";
import type { Opening } from "./opening.ts";
import type { Parts } from "./parts.ts";

/** Replies of one kind. */
type Of<Kind extends Reply["kind"]> = Extract<Reply, { kind: Kind }>;

export class Replies {
  readonly #parts: Parts;
  readonly #measurement: Measurement;
  readonly #opening: Opening;
  #started = false;

  constructor(parts: Parts, measurement: Measurement, opening: Opening) {
    this.#parts = parts;
    this.#measurement = measurement;
    this.#opening = opening;
  }

  take(reply: Reply): void {
    const { view, clearance } = this.#parts;
    // A run's replies are dropped while its models are not drawn, or their clearance is measured
    // instead. Distances are measured again afterwards.
    const isUnwanted = view.isDrafting || clearance.active;
    if (isUnwanted && "run" in reply && reply.run !== undefined) return;
    switch (reply.kind) {
      case "ready":
      case "loading":
      case "draft":
      case "loaded":
      case "restored":
      case "closed":
        this.#ofModels(reply);
        break;
      case "progress":
      case "measured":
      case "cancelled":
      case "failed":
        this.#ofRun(reply);
        break;
      case "bodies":
      case "facts":
      case "overlap":
      case "check":
        this.#ofBodies(reply);
        break;
      default:
        this.#ofOthers(reply);
    }
  }

  #ofModels(reply: Of<"ready" | "loading" | "draft" | "loaded" | "restored" | "closed">): void {
    const { view, faces, facts, overlap, check } = this.#parts;
    switch (reply.kind) {
      case "ready":
        warnings.showEngine(reply.engine);
        // A worker that replaces another loads the models of that one.
        if (this.#started) break;
        this.#started = true;
        fillShapes(reply.shapes);
        void this.#opening.openFirst();
        break;
      case "loading":
        setLoading(true, reply.text);
        break;
      case "draft":
        this.#opening.showDraft(reply);
        break;
      case "loaded":
        this.#opening.showLoaded(reply);
        break;
      case "restored":
        // What the worker before computed has no end.
        if (isFitting()) clearFit();
        faces.end();
        overlap.end();
        check.end();
        facts.replaced();
        this.#measurement.measure();
        break;
      case "closed":
        view.close(reply.side);
        this.#measurement.show();
        break;
    }
  }

  #ofRun(reply: Of<"progress" | "measured" | "cancelled" | "failed">): void {
    const { view } = this.#parts;
    switch (reply.kind) {
      case "progress":
        resultPanel.showWorking(reply.fraction, reply.interval, view.models.diagonal, {
          symmetric: distanceOptions.value.symmetric === true,
          stalled: reply.stalled,
        });
        break;
      case "measured":
        this.#measured(reply);
        break;
      case "cancelled":
        this.#cancelled(reply);
        break;
      case "failed":
        this.#failed(reply);
        break;
    }
  }

  #ofBodies(reply: Of<"bodies" | "facts" | "overlap" | "check">): void {
    const { view, facts, overlap, check } = this.#parts;
    switch (reply.kind) {
      case "bodies":
        view.models.explosion.bodies = reply.faces;
        setBodies(reply.faces);
        this.#measurement.show();
        break;
      case "facts":
        facts.show(reply, view.models.aside);
        break;
      case "overlap":
        // Volumes that ended because A was moved are no longer shown.
        if (overlap.active) overlap.show(reply);
        break;
      case "check":
        if (check.active) check.show(reply);
        break;
    }
  }

  #ofOthers(reply: Of<"clearance" | "diff" | "bound" | "fit" | "probed" | "csv">): void {
    const { view, clearance, faces, probing } = this.#parts;
    switch (reply.kind) {
      case "clearance":
        if (clearance.active) showMeeting(view, clearance.show(reply));
        break;
      case "diff":
        // A comparison that ended because A was moved is no longer shown.
        if (faces.active || reply.state === "working") faces.show(reply);
        break;
      case "bound":
        this.#measurement.showBounds(reply);
        break;
      case "fit":
        this.#showFitted(reply);
        break;
      case "probed":
        probing.show(reply.id, reply.probe);
        break;
      case "csv":
        download("hausdorff.csv", reply.table);
        break;
    }
  }

  #measured(reply: Of<"measured">): void {
    const { client } = this.#parts;
    const last = client.isNewest(reply.run);
    resultPanel.showResult(reply.result, { last, pending: reply.pending });
    this.#measurement.showMeasured(reply);
    warnings.showEngine(reply.engine);
    warnings.showResultNotice(reply.result.notice, reply.engine);
    // Before the colours are computed, which those of the finer measurement would replace.
    if (client.isNewest(reply.run)) this.#measurement.refine();
  }

  #cancelled({ run, interval }: Of<"cancelled">): void {
    const { client, view } = this.#parts;
    if (!client.isNewest(run)) return;
    resultPanel.clearResult("cancelled");
    if (interval !== undefined) resultPanel.showReached(interval, view.models.diagonal);
    this.#measurement.hideResult();
  }

  #failed({ run, code, message }: Of<"failed">): void {
    const { client, view } = this.#parts;
    if (run !== undefined && !client.isNewest(run)) return;
    resultPanel.showError(code, message);
    if (run === undefined) {
      setLoading(false);
      showNames(view.models.drawn);
      if (this.#opening.showBefore()) this.#measurement.measure();
    }
    // After a file that could not be loaded, the old models and their result stay.
    if (run !== undefined || !view.models.complete) {
      resultPanel.clearResult("failed");
      this.#measurement.hideResult();
    }
  }

  #showFitted(reply: FitReply): void {
    const { models } = this.#parts.view;
    // A fit that ended because A was moved is no longer shown.
    if (!isFitting()) return;
    if (reply.state === "done") {
      const { move, rotation } = Pose.of(reply.fit.transform, models.middle);
      clearFit();
      setComputedPosition(move, degreesOf(rotation));
    } else if (reply.state === "failed") resultPanel.showError(reply.code, reply.message);
    showFit(reply, models.diagonal);
  }
}
