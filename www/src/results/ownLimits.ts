// What is allowed of single faces where it differs from the whole's: in a control of the form, so
// that links, undoing and kept files hold it.
import { computed } from "@preact/signals-core";
import type { Allowed } from "../scene/colors/scale.ts";
import { field, onChange, understands } from "../state/store.ts";
import type { Side } from "../worker/protocol.ts";

const control = field("own-limits");

/** A face and what is allowed of it. */
export interface OwnLimit extends Allowed {
  side: Side;
  face: number;
}

/** `a3:0.1/0.2`: face 3 of A, up to 0.1 above and 0.2 below. */
const ENTRY = /^([ab])(\d{1,9}):([\d.e+-]+)\/([\d.e+-]+)$/i;
/** `0.1`, `±0.1` or `+0.2/-0.1`, with any minus. */
const TYPED = /^[+±]?([\d.]+(?:e[+-]?\d+)?)(?:\s*\/\s*[-−]?([\d.]+(?:e[+-]?\d+)?))?$/i;

const all = computed((): readonly OwnLimit[] => limitsIn(control.value));
understands(
  "own-limits",
  (text) => text === "" || limitsIn(text).length === text.split(",").length,
);

function limitsIn(text: string): OwnLimit[] {
  return text.split(",").flatMap((entry) => {
    const [, side, face, above, below] = ENTRY.exec(entry) ?? [];
    const allowed = allowedBy(above, below);
    return allowed === undefined ? [] : [{ side: side as Side, face: Number(face), ...allowed }];
  });
}

/** All faces that have limits of their own. */
export const ownLimits = (): readonly OwnLimit[] => all.value;

/** What is allowed of a face by its own limits. */
export const ownLimit = (side: Side, face: number): OwnLimit | undefined =>
  ownLimits().find((own) => own.side === side && own.face === face);

/** Calls back when the limits of a face change. */
export const onOwnLimits = (callback: () => void): void => onChange(() => all.value, callback);

/** Sets what is allowed of a face from what the user typed; nothing removes it. Returns false for no number. */
export function setOwnLimit(side: Side, face: number, typed: string): boolean {
  const [, above, below] = TYPED.exec(typed.trim()) ?? [];
  const allowed = allowedBy(above, below ?? above);
  if (allowed === undefined && typed.trim() !== "") return false;
  const others = ownLimits().filter((own) => own.side !== side || own.face !== face);
  write(allowed === undefined ? others : [...others, { side, face, ...allowed }]);
  return true;
}

/** Removes the limits of all faces: the models are new. */
export const clearOwnLimits = (): void => write([]);

/** The limits as the user types them. */
export const limitText = ({ above, below }: Allowed): string =>
  above === below ? `${above}` : `+${above}/-${below}`;

function write(all: readonly OwnLimit[]): void {
  control.set(
    all.map(({ side, face, above, below }) => `${side}${face}:${above}/${below}`).join(","),
  );
}

function allowedBy(above: string | undefined, below: string | undefined): Allowed | undefined {
  const limits = { above: Number(above), below: Number(below) };
  return Object.values(limits).every((limit) => Number.isFinite(limit)) ? limits : undefined;
}
