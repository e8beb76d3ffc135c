// The panel of the check of bodies: which pairs clash, touch or come near, and what is wrong with single bodies.

import { effect, signal, untracked } from "@preact/signals-core";
import type { BodyPair, CheckResult, Vector3 } from "nurbs-hausdorff";
import { element, fillList } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { unitScale } from "../files/units.ts";
import { onChange } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import type { CheckedFaces, CheckOf, CheckReply, CheckState, Side } from "../worker/protocol.ts";
import { bodyRow, pairRow, ruleRow } from "./rows.ts";
import { rules } from "./rules.ts";
import { faultsOf, pairText, unkeptText, verdictText } from "./words.ts";

/** Rows of each list; more are counted. */
const MAX_ROWS = 100;

type Done = Extract<CheckState, { state: "done" }>;

const section = element("check");
const of = element("check-of", HTMLSelectElement);
const below = element("check-below", HTMLInputElement);
const progress = element("check-progress", HTMLProgressElement);
const text = element("check-text");
const pairs = element("check-pairs");
const bodies = element("check-bodies");
const back = element("check-back");
const unkept = element("check-rules-unkept");
const outdated = element("rules-outdated");

/** One or two bodies, with the place that matters and what is said there. */
export interface ShownBodies {
  bodies: CheckedFaces[];
  place?: { point: Vector3; of: CheckOf; text: string };
}

export interface CheckListener {
  /** The user requests a check. */
  check: (of: CheckOf, below: number) => void;
  cancel: () => void;
  /** The bodies to show alone; without any, the models again. */
  show: (shown: ShownBodies | undefined) => void;
}

export class CheckPanel {
  readonly #listener: CheckListener;
  readonly #done = signal<Done | undefined>(undefined);

  constructor(listener: CheckListener) {
    this.#listener = listener;
    // Also in the unit that is shown, and whenever that changes.
    effect(() => this.#draw(this.#done.value));
    element("check-start").addEventListener("click", () => {
      if (!below.reportValidity()) return;
      this.clear("", "working");
      listener.check(of.value as CheckOf, this.#below);
    });
    element("check-cancel").addEventListener("click", () => listener.cancel());
    back.addEventListener("click", () => this.unshow());
    onChange(
      () => rules.value,
      () => {
        if (this.#done.peek() !== undefined) outdated.hidden = false;
      },
    );
  }

  /** The distance below which bodies are near, in the units of what is checked. */
  get #below(): number {
    const value = below.valueAsNumber;
    return Number.isFinite(value) ? value / scaleOf(of.value as CheckOf) : 0;
  }

  /** What was found; none before a check. */
  get result(): CheckResult | undefined {
    return this.#done.peek()?.result;
  }

  /** The verdict, pairs and faulty bodies. */
  get tables(): ReportTable[] {
    const done = this.#done.peek();
    if (done === undefined) return [];
    const { of: checked, result } = done;
    const isOfBoth = checked === "both";
    const pairs = listedPairs(result).map((pair) => [
      pair.intended
        ? texts.bodies.stateMeant(texts.bodies.states[pair.state])
        : texts.bodies.states[pair.state],
      texts.bodies.pairOf(pair.a, pair.b),
      pairText(pair, scaleOf(checked)),
    ]);
    const faulty = result.bodies.flatMap((body) => {
      const faults = faultsOf(body, isOfBoth);
      return faults.length === 0 ? [] : [[texts.bodies.body, body.name, faults.join(", ")]];
    });
    const broken = result.rules.map((rule) => [
      ...[
        texts.bodies.oneRule,
        rule.rule === "mustTouch" ? rule.a : texts.bodies.pairOf(rule.a, rule.b),
      ],
      unkeptText(rule, scaleOf(checked)),
    ]);
    const subject = isOfBoth ? texts.bodies.aAndBAsOne : checked.toUpperCase();
    const title = texts.bodies.checkOfTheBodiesOf(subject, verdictText(result));
    return [
      {
        title,
        head: [texts.bodies.state, texts.bodies.bodies, ""],
        rows: [...broken, ...pairs, ...faulty],
      },
    ];
  }

  /** Whether both models are checked together, where their files place them. */
  get isOfBoth(): boolean {
    return (
      this.#done.peek()?.of === "both" ||
      (section.dataset.state === "working" && of.value === "both")
    );
  }

  show(reply: CheckReply): void {
    switch (reply.state) {
      case "working":
        progress.value = reply.fraction;
        break;
      case "done":
        this.clear("", "done");
        this.#done.value = reply;
        break;
      case "cancelled":
        this.clear(texts.bodies.cancelled);
        break;
      case "failed":
        this.clear(`${reply.message} (${reply.code})`);
        break;
    }
  }

  /** Whether a check is shown or in progress. */
  get active(): boolean {
    return section.dataset.state === "done" || section.dataset.state === "working";
  }

  /** Ends a check in progress, whose result will not come. */
  end(): void {
    if (section.dataset.state === "working") this.clear(texts.bodies.cancelled);
  }

  /** Removes what is shown, and says this. */
  clear(message: string, state = "idle"): void {
    this.unshow();
    section.dataset.state = state;
    progress.value = 0;
    delete section.dataset.verdict;
    element("check-work").hidden = state !== "working";
    this.#done.value = undefined;
    text.textContent = message;
    for (const list of [pairs, bodies, unkept]) list.replaceChildren();
    outdated.hidden = true;
    element("check-faults").hidden = true;
  }

  #draw(done: Done | undefined): void {
    if (done === undefined) return;
    const { result } = done;
    untracked(() => this.unshow());
    text.textContent = verdictText(result);
    section.dataset.verdict = `${result.clean ?? "undecided"}`;
    const isOfBoth = done.of === "both";
    const rowsOf = { isOfBoth, scale: scaleOf(done.of) };
    unkept.replaceChildren(...result.rules.slice(0, MAX_ROWS).map((rule) => ruleRow(rule, rowsOf)));
    const indices = new Map(result.bodies.map(({ name }, index) => [name, index]));
    fillList(pairs, listedPairs(result), MAX_ROWS, (pair) =>
      pairRow(pair, rowsOf, (button, label) => {
        const both = [pair.a, pair.b].flatMap((name) => done.bodies[indices.get(name) ?? -1] ?? []);
        this.#show(button, {
          bodies: both,
          place: { point: pair.point, of: done.of, text: label },
        });
      }),
    );
    const faulty = [...result.bodies.entries()].flatMap(([index, body]) => {
      const faults = faultsOf(body, isOfBoth);
      return faults.length === 0 ? [] : [{ index, body, faults }];
    });
    element("check-faults").hidden = faulty.length === 0;
    fillList(bodies, faulty, MAX_ROWS, ({ index, body, faults }) =>
      bodyRow(body, faults, rowsOf, (button) => {
        const own = done.bodies[index];
        this.#show(button, { bodies: own === undefined ? [] : [own] });
      }),
    );
  }

  #show(button: HTMLButtonElement, shown: ShownBodies): void {
    const isShown = button.getAttribute("aria-pressed") === "true";
    this.unshow();
    if (isShown) return;
    button.setAttribute("aria-pressed", "true");
    section.dataset.shown = "true";
    back.hidden = false;
    this.#listener.show(shown);
  }

  /** Shows the models again instead of single bodies. */
  unshow(): void {
    if (section.dataset.shown === undefined) return;
    delete section.dataset.shown;
    back.hidden = true;
    for (const button of section.querySelectorAll("[aria-pressed=true]")) {
      button.setAttribute("aria-pressed", "false");
    }
    this.#listener.show(undefined);
  }
}

/** The pairs that matter: not those that are apart. */
const listedPairs = ({ pairs }: CheckResult): BodyPair[] =>
  pairs.filter(({ state }) => state !== "apart");

/** A's units in one of those that a check is in: a check of both is in A's. */
const scaleOf = (one: CheckOf | Side): number => (one === "b" ? unitScale() : 1);
