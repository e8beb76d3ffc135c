import { compiledModule } from "../../wasm/nurbs_hausdorff.js";
import { Channel } from "../channel.js";
import type { Connect } from "../messages.js";
import type { Target } from "./target.js";

/**
 * A worker that measures blocks for the first one. It has the first one's compiled module, and the models that it
 * was sent.
 * @internal
 */
export class Helper {
  readonly #channel: Channel;
  readonly #started: Promise<unknown>;
  /** The numbers of its models, by those of the first worker's. */
  readonly #models = new Map<number, Promise<number>>();

  constructor(connect: Connect) {
    this.#channel = new Channel((listener) => connect(listener, undefined));
    this.#started = this.#channel.call("create", [{ backend: "cpu", module: compiledModule() }]);
    // Who measures hears of it.
    this.#started.catch(() => {});
  }

  /** Whether it was sent a model. */
  has({ id }: Target): boolean {
    return this.#models.has(id);
  }

  /** Sends it a model unless it has it; resolves to whether it has it now. */
  async receive(target: Target): Promise<boolean> {
    await this.#started;
    let sent = this.#models.get(target.id);
    if (sent === undefined) {
      const { source } = target;
      if (source === undefined) return false;
      sent = this.#channel.call("source", [source]).then(([, own]) => own);
      this.#models.set(target.id, sent);
    }
    await sent;
    return true;
  }

  /** Calls a method on a model that it has received. */
  async call<Part>(
    method: "closestPointsOfBlock" | "signedDistancesOfLayer",
    { id }: Target,
    args: unknown[],
    signal: AbortSignal,
    transfer: ArrayBuffer[] = [],
  ): Promise<Part> {
    const own = await this.#models.get(id);
    const [found] = await this.#channel.call(method, [own, ...args], { signal, transfer });
    return found as Part;
  }

  /** Frees its copy of a model. */
  drop(id: number): void {
    void this.#models.get(id)?.then(
      (own) => this.#channel.drop(own),
      () => {},
    );
    this.#models.delete(id);
  }

  /** Ends it once its calls are answered. */
  close(): void {
    this.#channel.close();
  }
}
