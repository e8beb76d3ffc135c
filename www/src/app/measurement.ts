// The measurement of the models as they are: its options, what is shown of it, and the finer ones
// that a verdict needs.

import { checkRules } from "../check/rules.ts";
import { showMeeting } from "../clearance/meeting.ts";
import { element } from "../common/elements.ts";
import { clearFit, isFitting, showFitting } from "../controls/bestFit.ts";
import { display } from "../controls/display.ts";
import { exploded } from "../controls/explode.ts";
import { fitChoice } from "../controls/fitChoice.ts";
import { distanceOptions, overlays, paint } from "../controls/options.ts";
import { isInPlace, position } from "../controls/position.ts";
import { section, showOffset } from "../controls/section.ts";
import { visibilities } from "../controls/visibilities.ts";
import { drawCut } from "../inspection/cut/view.ts";
import * as deviation from "../inspection/deviationPanel.ts";
import { ownLimits } from "../results/ownLimits.ts";
import * as resultPanel from "../results/resultPanel.ts";
import { allowed, needsPrecision } from "../results/verdict.ts";
import { Pose } from "../scene/pose.ts";
import { texts } from "../texts/index.ts";
import type {
  BoundReply,
  CheckOf,
  PlainDiffOptions,
  PlainFitOptions,
  PlainOptions,
  Reply,
} from "../worker/protocol.ts";
import type { Parts } from "./parts.ts";

/** Seconds after which pairs of bodies that are not searched yet are bounded once only. */
const CHECK_SECONDS = 120;

/** The finest tolerance, in diagonals, and the factor to it from one that does not decide. */
const FINEST = 1e-9;
const FINER = 30;

export class Measurement {
  readonly #parts: Parts;
  /** The tolerance of a measurement that the user's precision did not decide. */
  #finer: number | undefined;
  /** The run whose colours are shown, once they are as fine as they get. */
  #colored: number | undefined;

  constructor(parts: Parts) {
    this.#parts = parts;
  }

  /** Measures with the user's precision again, as options or models are others. */
  forgetFiner(): void {
    this.#finer = undefined;
  }

  pose(): Pose {
    const { middle } = this.#parts.view.models;
    const { move, angles } = position.value;
    return new Pose(move, angles, middle);
  }

  /** The options of a measurement of the models as they are now. */
  get options(): PlainOptions {
    return {
      ...distanceOptions.value,
      ...(this.#finer !== undefined && { relativeTolerance: this.#finer }),
      transform: this.pose().transform,
      scaleUnits: true,
    };
  }

  diffOptions(limit: number): PlainDiffOptions {
    return {
      ...{ limit, transform: this.pose().transform, scaleUnits: true },
      own: ownLimits().map(({ side, face, above, below }) => ({
        ...{ side, face, limit: Math.min(above, below) },
      })),
    };
  }

  /** Moves A to where it fits B: by all of it, or from where these pairs of points or datums lay it. */
  fit(start: Partial<Pick<PlainFitOptions, "pairs" | "datums" | "norm">>): void {
    const choice = fitChoice();
    if (choice === undefined) return;
    showFitting(start.norm === "none");
    const { transform } = this.pose();
    this.#parts.client.fit({ transform, scaleUnits: true, ...choice, ...start });
  }

  /** Measures the volumes that the models have in common and apart, as they are placed. */
  overlap(maxSeconds: number): void {
    const { client, overlap, view } = this.#parts;
    const { transform } = this.pose();
    if (view.models.complete) client.overlap({ maxSeconds, transform, scaleUnits: true });
    else overlap.clear(texts.files.openTwoFilesFirst);
  }

  /** Checks all pairs of bodies by the rules: of one model, or of both, A where it was moved to. */
  check(of: CheckOf, below: number): void {
    const { client, check, view } = this.#parts;
    const isThere = of === "both" ? view.models.complete : view.models.drawn[of] !== undefined;
    if (!isThere) check.clear(texts.files.openAFileFirst);
    else {
      const rules = checkRules();
      const options = {
        below,
        maxSeconds: CHECK_SECONDS,
        scaleUnits: true,
        ...(rules && { rules }),
      };
      const isMoved = of === "both" && !isInPlace.value;
      client.check(of, options, isMoved ? this.pose().transform : undefined);
    }
  }

  /** Measures anew after A was moved: what was found of another position is no longer shown. */
  moved(): void {
    const { client, probing, measuring, faces, overlap, check, past } = this.#parts;
    resultPanel.hideError();
    if (isFitting()) client.cancelFit();
    clearFit();
    probing.clear();
    measuring.end();
    this.forgetFiner();
    if (faces.active) {
      client.cancelDiff();
      faces.clear("outdated", texts.files.aWasMovedCompareAgain);
    }
    if (overlap.active) {
      client.cancelOverlap();
      overlap.clear(texts.files.aWasMovedMeasureAgain);
    }
    if (check.isOfBoth) {
      client.cancelCheck();
      check.clear(texts.files.aWasMovedCheckAgain);
    } else check.unshow();
    past.record();
    this.measure();
  }

  /** Measures the models: their deviation, or while the user wants it their clearance. */
  measure(): void {
    const { client, view, clearance } = this.#parts;
    client.cancelBound();
    delete element("points").dataset.bounded;
    if (view.models.aside !== undefined) this.#showNone("lone");
    if (!view.models.complete) return;
    if (clearance.active) {
      // The deviation shown is no longer that of the models as they are.
      this.#showNone("paused");
      clearance.showPending();
      const { transform } = this.pose();
      client.clearance({ below: clearance.below, transform, scaleUnits: true });
      return;
    }
    this.show();
    resultPanel.showPending();
    client.measure(this.options, paint.value);
  }

  #showNone(state: "lone" | "paused"): void {
    this.#parts.client.cancel();
    resultPanel.clearResult(state);
    this.hideResult();
    this.show();
  }

  /** Turns to the deviation after clearance, or to clearance. */
  turn(): void {
    const { client, view, clearance, check } = this.#parts;
    if (clearance.active) check.unshow();
    else {
      client.cancelClearance();
      showMeeting(view, undefined);
    }
    this.measure();
  }

  /** Measures again with a finer tolerance where the verdict needs it, down to what float64 has. */
  refine(): void {
    const { result } = this.#parts.view;
    if (result?.method !== "certified" || !result.converged || !needsPrecision()) return;
    const now = this.#finer ?? distanceOptions.value.relativeTolerance ?? FINEST;
    const reached = (result.upper - result.lower) / result.diagonal;
    // An interval that is narrow enough for the finest tolerance is the one that it would give.
    if (now <= FINEST || reached <= FINEST) return;
    this.#finer = Math.max(FINEST, now / FINER);
    this.measure();
  }

  /** Draws the models as the controls of the view say. */
  show(): void {
    const { view } = this.#parts;
    view.show(this.pose(), overlays.value, {
      ...display.value,
      visibility: visibilities(view.models, view.result, deviation.paintedSides()),
      section: section.value,
      exploded: exploded.value,
    });
    showOffset(view.models);
    drawCut(view.models);
  }

  /** Draws maps in their colours. */
  paint({ scale, maps, isSame }: deviation.Painting): void {
    const { view } = this.#parts;
    if (isSame) {
      view.rescale(scale);
      return;
    }
    view.showMaps(maps, scale);
    this.show();
  }

  /** Shows a result and its colours; those before stay until new ones replace them. */
  showMeasured({ run, result, maps, pending }: Extract<Reply, { kind: "measured" }>): void {
    const { view, places } = this.#parts;
    const hasMaps = Object.keys(maps).length > 0;
    const replaced = hasMaps || !pending;
    view.showResult(result, replaced);
    if (replaced) deviation.hideMaps();
    if (hasMaps) this.paint(deviation.showMaps(result, maps));
    else this.show();
    if (!replaced) return;
    places.show();
    drawCut(view.models);
    this.#colored = pending ? undefined : run;
    this.boundFaces();
  }

  hideResult(): void {
    const { view, places } = this.#parts;
    view.hideResult();
    deviation.hideMaps();
    places.show();
    drawCut(view.models);
  }

  /** Asks what is certain of each face, for what is allowed now, once the colours are there. */
  boundFaces(): void {
    const { client } = this.#parts;
    const limits = allowed();
    client.cancelBound();
    if (this.#colored === undefined || !client.isNewest(this.#colored)) return;
    if (limits === undefined || deviation.painted() === undefined) return;
    const limit = Math.min(limits.above, limits.below);
    if (limit > 0) client.bound(this.#colored, this.diffOptions(limit));
  }

  showBounds(reply: BoundReply): void {
    const { client, places } = this.#parts;
    if (reply.state !== "done" || !client.isNewest(reply.run)) return;
    if (reply.run !== this.#colored) return;
    deviation.bound(reply.result, reply.maps);
    places.show();
    element("points").dataset.bounded = `${reply.result.limit}`;
  }
}
