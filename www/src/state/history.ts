// Undo and redo of all options and of the position, and the state in the page's address.
import { element } from "../common/elements.ts";
import { formState } from "./formState.ts";

/** Milliseconds without a change after which a state is recorded: a drag is one step. */
const PAUSE = 150;
/** The largest number of states kept. */
const MAX_STATES = 200;

/** The camera's parameter, and significant digits of its place. */
export const CAMERA = "camera";
const CAMERA_DIGITS = 5;

/** Controls whose values are about one pair of models. */
const OF_PAIR = [
  ...[
    "a",
    "b",
    "limit",
    "limit-below",
    "own-limits",
    "below",
    "range",
    "range-below",
    "section-at",
  ],
  ...["section-free", "section-tilt", "section-turn", "annotations", "measures", "check-rules"],
  ...["x", "y", "z", "turn-x", "turn-y", "turn-z"],
];

const undoButton = element("undo", HTMLButtonElement);
const redoButton = element("redo", HTMLButtonElement);
const loading = element("loading");

export class History {
  readonly #restore: (state: string) => void;
  /** Called with the state whenever it changes. */
  onState: (state: string) => void = () => {};
  /** Whether a model is of a file: an address that does not name it holds nothing about the pair. */
  ofFiles = false;
  /** The parameters that name the files compared, which an address does not hold. */
  #files = "";
  #camera = "";
  #past: string[] = [];
  #future: string[] = [];
  #current: string | undefined;
  #timer = 0;

  /** Calls `restore` with the state to return to. */
  constructor(restore: (state: string) => void) {
    this.#restore = restore;
    undoButton.addEventListener("click", () => this.#step(this.#past, this.#future));
    redoButton.addEventListener("click", () => this.#step(this.#future, this.#past));
    window.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || isTextField(event.target)) return;
      const key = event.key.toLowerCase();
      const redo = key === "y" || (key === "z" && event.shiftKey);
      if (!redo && key !== "z") return;
      event.preventDefault();
      (redo ? redoButton : undoButton).click();
    });
    this.#showButtons();
  }

  /** The state in the page's address, if there is one. */
  static get linked(): string | undefined {
    return location.hash.length > 1 ? location.hash.slice(1) : undefined;
  }

  /** The camera's place in a state. */
  static cameraOf(state: string | undefined): number[] | undefined {
    const numbers = (new URLSearchParams(state).get(CAMERA) ?? "").split(",").map(Number);
    const valid = numbers.length === 6 && numbers.every((value) => Number.isFinite(value));
    return valid && numbers.slice(0, 3).some((value, axis) => value !== numbers[axis + 3])
      ? numbers
      : undefined;
  }

  /** Keeps the camera's place in the address; undoing does not move it. */
  set camera(place: number[]) {
    const text = place.map((value) => `${Number(value.toPrecision(CAMERA_DIGITS))}`).join(",");
    if (text === this.#camera) return;
    this.#camera = text;
    if (this.#current !== undefined) this.#show(this.#current);
  }

  /** Names the files compared in the address. */
  set files(parameters: string) {
    this.#files = parameters;
    if (this.#current !== undefined) this.#show(this.#current);
  }

  /** Records the state of the controls, once they rest. */
  record(): void {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#record(), PAUSE);
  }

  /** Forgets all states, because their models cannot be opened again. */
  reset(): void {
    this.#past = [];
    this.#future = [];
    this.#current = undefined;
    this.record();
  }

  #record(): void {
    // While models are read the form has something of both pairs.
    if (!loading.hidden) {
      this.record();
      return;
    }
    const state = formState();
    if (state === this.#current) return;
    if (this.#current !== undefined) {
      this.#past = [...this.#past, this.#current].slice(-MAX_STATES);
      this.#future = [];
    }
    this.#show(state);
  }

  #step(from: string[], to: string[]): void {
    clearTimeout(this.#timer);
    this.#record();
    const state = from.pop();
    if (state === undefined || this.#current === undefined) return;
    to.push(this.#current);
    this.#show(state);
    this.#restore(state);
  }

  #show(state: string): void {
    this.#current = state;
    this.onState(state);
    const own = this.ofFiles && this.#files === "" ? withoutPair(state) : state;
    const camera = this.#camera === "" ? "" : `${CAMERA}=${this.#camera}`;
    const shared = [this.#files, own, camera].filter((part) => part !== "").join("&");
    history.replaceState(null, "", shared === "" ? location.pathname : `#${shared}`);
    this.#showButtons();
  }

  #showButtons(): void {
    undoButton.disabled = this.#past.length === 0;
    redoButton.disabled = this.#future.length === 0;
  }
}

/** The state that holds for any pair: another one is not judged by this one's limit. */
function withoutPair(state: string): string {
  const parameters = new URLSearchParams(state);
  for (const name of OF_PAIR) parameters.delete(name);
  return parameters.toString();
}

/** Whether the browser's own undo applies. */
const isTextField = (target: EventTarget | null): boolean =>
  target instanceof HTMLTextAreaElement ||
  (target instanceof HTMLInputElement && target.type === "number");
