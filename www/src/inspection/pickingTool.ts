// Tools by which clicks on the view are for something of their own while a button is pressed: one at a time.
import { element } from "../common/elements.ts";

/** What a click on the view is for, at a place of it. */
export type Click = (x: number, y: number) => void;

/** Is told what the next clicks are for, and `undefined` when they are for nothing special any more. */
export type Take = (click: Click | undefined) => void;

interface Use {
  button: HTMLButtonElement;
  take: Take;
  click: Click;
  turned?: (on: boolean) => void;
  /** Takes back what Escape is for before it ends the tool, and returns whether there was such a thing. */
  back?: () => boolean;
}

const tools: PickingTool[] = [];

export class PickingTool {
  readonly #use: Use;

  constructor(use: Use) {
    this.#use = use;
    tools.push(this);
    use.button.addEventListener("click", () => this.#turn(!this.active));
    window.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || event.defaultPrevented || !this.active) return;
      event.preventDefault();
      if (use.back?.() !== true) this.end();
    });
  }

  /** Whether clicks on the view are this tool's. */
  get active(): boolean {
    return this.#use.button.getAttribute("aria-pressed") === "true";
  }

  end(): void {
    if (this.active) this.#turn(false);
  }

  #turn(on: boolean): void {
    const { button, take, click, turned } = this.#use;
    button.setAttribute("aria-pressed", `${on}`);
    for (const tool of tools) if (on && tool !== this) tool.end();
    take(on ? click : undefined);
    element("canvas").classList.toggle("picking", on);
    turned?.(on);
  }
}
