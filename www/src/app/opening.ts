// Opening of models: what the page begins with, files, links that name files, and what is shown
// while they are read.

import { clearAnnotations } from "../annotations/annotations.ts";
import { element } from "../common/elements.ts";
import { clearFit } from "../controls/bestFit.ts";
import { offerFileColors } from "../controls/display.ts";
import { needsBodies, setBodies } from "../controls/explode.ts";
import { setPlacement } from "../controls/position.ts";
import { IN_PLACE, presets } from "../controls/presets.ts";
import {
  asideSide,
  leaveAside,
  note,
  type Opened,
  openShapes,
  setLoading,
  showMissing,
  showReading,
  showSources,
  sourcesOf,
} from "../controls/sources.ts";
import { AskedFiles } from "../files/asked.ts";
import { showFileNotes } from "../files/fileNotes.ts";
import {
  FILE_PARAMETERS,
  type FileName,
  filesNamedBy,
  nameOf,
  parametersOf,
} from "../files/identity.ts";
import { forgetFiles, keepFiles, keepLast, keptFiles, lastFiles } from "../files/kept.ts";
import { showScanNote } from "../files/scanNote.ts";
import { showUnits, unitScale } from "../files/units.ts";
import { clearMeasures } from "../measuring/measures.ts";
import { clearOwnLimits } from "../results/ownLimits.ts";
import * as resultPanel from "../results/resultPanel.ts";
import { applyFormState, formState, notUnderstood } from "../state/formState.ts";
import { CAMERA, History } from "../state/history.ts";
import { texts } from "../texts/index.ts";
import {
  type Placement,
  type Reply,
  SIDES,
  type Side,
  type Sides,
  type Source,
} from "../worker/protocol.ts";
import type { Measurement } from "./measurement.ts";
import type { Parts } from "./parts.ts";

export class Opening {
  readonly #parts: Parts;
  readonly #measurement: Measurement;
  readonly #asked = new AskedFiles(showMissing, () => openShapes());
  /** Controls that are set only after the models of their state are loaded. */
  #pending: string | undefined;
  /** The files compared, as links name them. */
  #named: Sides<FileName> = {};
  /** The state of the link whose files are asked for. */
  #linked: string | undefined;

  constructor(parts: Parts, measurement: Measurement) {
    this.#parts = parts;
    this.#measurement = measurement;
    parts.past.onState = (state) => {
      if (Object.keys(this.#named).length > 0) void keepLast(this.#named, state);
    };
  }

  /** Sets all controls to a state, after its models were opened if they are others. */
  restore(state: string): void {
    if (openShapes(state)) this.#pending = state;
    else applyFormState(state);
  }

  /** Opens what the user chose. */
  take({ sources, placement, files }: Opened): void {
    resultPanel.hideError();
    if (this.#asked.isActive && files.length > 0) {
      void this.#asked.take(files).then((all) => {
        if (all === undefined) return;
        leaveAside(undefined);
        this.#pending = this.#linked;
        this.#read(all, IN_PLACE);
      });
      return;
    }
    // What was asked for is no longer wanted; the page always has two models.
    if (this.#asked.isActive) {
      this.#asked.end();
      const [example] = presets;
      const others = example && { a: { shape: example.a }, b: { shape: example.b } };
      this.#read({ ...others, ...sources }, placement);
    } else this.#read(sources, placement);
  }

  /** Reads a file again in a unit that the user says it is in; all else stays. */
  inUnit(side: Side, unit: number | undefined): void {
    const source = this.#parts.view.models.drawn[side]?.source;
    if (source === undefined || !("file" in source) || source.unit === unit) return;
    const { unit: _before, ...rest } = source;
    this.#pending = formState();
    this.#read({ [side]: unit === undefined ? rest : { ...rest, unit } }, IN_PLACE);
  }

  #read(sources: Sides<Source>, placement: Placement): void {
    const { view, client } = this.#parts;
    setLoading(true);
    showReading(sources);
    view.models.clearDrafts();
    client.load(sources, placement);
  }

  /** Ends reading; the models before keep their position and options. */
  stop(): void {
    const { client, view } = this.#parts;
    this.#pending = formState();
    client.stopLoading(IN_PLACE);
    setLoading(view.models.complete);
    this.showBefore();
  }

  /** Draws the models again whose replacement was drawn in part; returns whether there was any. */
  showBefore(): boolean {
    const { view } = this.#parts;
    if (!view.dropDrafts() || !view.models.complete) return false;
    this.#measurement.show();
    view.fit(true);
    return true;
  }

  /** Shows faces of a file as they are read; the result is that of models which are no longer drawn. */
  showDraft({ side, replaced, draft }: Extract<Reply, { kind: "draft" }>): void {
    const { view, probing } = this.#parts;
    setLoading(true, texts.files.reading(Math.floor(100 * draft.fraction)));
    if (!view.isDrafting) {
      probing.clear();
      this.#measurement.hideResult();
      resultPanel.clearResult("working");
    }
    view.showDraft(side, replaced, draft);
  }

  showLoaded({ models, placement }: Extract<Reply, { kind: "loaded" }>): void {
    const { view, tree, faces, past } = this.#parts;
    this.#forgetBefore();
    view.showModels(models);
    showSources(models, placement);
    view.models.aside = asideSide();
    showFileNotes(models);
    showScanNote(models);
    showUnits(models);
    view.models.scale = unitScale();
    tree.show(view.models.drawn);
    offerFileColors(view.models.hasFileColors);
    faces.propose(view.models.diagonal);
    setPlacement(placement, view.models.diagonal);
    void this.#keep();
    clearOwnLimits();
    clearAnnotations();
    clearMeasures();
    view.models.explosion.bodies = {};
    setBodies(undefined);
    const state = this.#pending;
    this.#pending = undefined;
    if (state !== undefined) applyFormState(state, ["a", "b"]);
    setLoading(false);
    if (needsBodies()) this.#parts.client.bodies();
    this.#measurement.hideResult();
    resultPanel.clearResult("working");
    this.#measurement.measure();
    this.#parts.facts.replaced();
    view.fit(true);
    const camera = History.cameraOf(state);
    if (camera !== undefined) view.camera = camera;
    const { drawn } = view.models;
    const fromFile = SIDES.some((side) => "file" in (drawn[side]?.source ?? {}));
    // What was before cannot be opened again where it was of files.
    const isOfFiles = fromFile || past.ofFiles;
    past.ofFiles = fromFile;
    if (isOfFiles) past.reset();
    else past.record();
  }

  /** Removes what was found of the models before. */
  #forgetBefore(): void {
    const { faces, probing, measuring, annotating, aligning, views, overlap, check } = this.#parts;
    faces.clear("idle", "");
    overlap.clear("");
    check.clear("");
    probing.clear();
    measuring.end();
    annotating.end();
    aligning.end();
    views.clear();
    clearFit();
    this.#measurement.forgetFiner();
  }

  /** Names the files compared in the address, and keeps them over a reload. */
  async #keep(): Promise<void> {
    const { view, past } = this.#parts;
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
    this.#named = Object.fromEntries(
      Object.entries(files).map(([side, { name, hash }]) => [side, { name, hash }]),
    );
    element("kept").hidden = Object.keys(files).length === 0;
    past.files = parametersOf(this.#named);
    await keepFiles(files);
  }

  /** Forgets the files that are kept in this browser. */
  forget(): void {
    this.#named = {};
    this.#parts.past.files = "";
    void forgetFiles();
    element("kept").hidden = true;
  }

  /** Opens what the page begins with: the address's shapes, the files that are kept, or the example. */
  async openFirst(): Promise<void> {
    const { linked } = History;
    await this.#openLinked(linked);
    if (linked !== undefined) noteLink(linked);
  }

  async #openLinked(linked: string | undefined): Promise<void> {
    const wanted = filesNamedBy(linked);
    if (linked !== undefined && Object.keys(wanted).length > 0) {
      await this.#openNamed(wanted, linked);
      return;
    }
    const parameters = new URLSearchParams(linked);
    if (!parameters.has("a") && !parameters.has("b")) {
      const last = await lastFiles();
      const kept = await keptFiles(last.files);
      const count = Object.keys(kept).length;
      if (count > 0 && count === Object.keys(last.files).length) {
        await this.#openNamed(last.files, last.state);
        return;
      }
    }
    if (linked !== undefined && openShapes(linked)) this.#pending = linked;
    else openShapes();
  }

  /** Opens the files that a state is about; asks for those that are not kept here. */
  async #openNamed(wanted: Sides<FileName>, state: string): Promise<void> {
    const sources = sourcesOf(await keptFiles(wanted));
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
      this.#pending = state;
      this.#read(sources, IN_PLACE);
      return;
    }
    this.#linked = state;
    this.#asked.ask(wanted, sources);
    resultPanel.clearResult("asked");
  }
}

/** Says which parameters of a link are damaged or unknown, as their values are not shown. */
function noteLink(linked: string): void {
  const isCamera = History.cameraOf(linked) !== undefined;
  const names = notUnderstood(linked, [...FILE_PARAMETERS, ...(isCamera ? [CAMERA] : [])]);
  if (names.length > 0) note(texts.files.theLinkIsDamaged(names.join(", ")));
}
