// Lists in controls of the form, so that links, undoing and kept files hold them: a row of JSON an entry.
import { computed, type ReadonlySignal } from "@preact/signals-core";
import { field, understands } from "./store.ts";

/** The most entries of a list: a link holds them. */
const MAX_COUNT = 60;
/** Significant digits of coordinates. */
const DIGITS = 9;

export interface KeptList<T> {
  /** All entries, in the order in which they were made: their numbers are from 1. */
  readonly all: ReadonlySignal<readonly T[]>;
  /** Replaces all entries. */
  write: (all: readonly T[]) => void;
  /** Whether there is room for another one. */
  hasRoom: () => boolean;
  /** Adds one, and returns its index; undefined where there is no room for another one. */
  add: (entry: T) => number | undefined;
}

/**
 * The list in the control of a name. `rowOf` gives the row of an entry, and `entryOf` the entry of a row that a link
 * has, which may be anything: undefined where it is none.
 */
export function keptList<T>(
  name: string,
  rowOf: (entry: T) => readonly unknown[],
  entryOf: (row: readonly unknown[]) => T | undefined,
): KeptList<T> {
  const state = field(name);
  const parsed = (rows: readonly unknown[]): T[] =>
    rows.flatMap((row) => {
      const entry = Array.isArray(row) ? entryOf(row) : undefined;
      return entry === undefined ? [] : [entry];
    });
  understands(name, (text) => {
    const rows = rowsOf(text);
    return rows !== undefined && rows.length <= MAX_COUNT && parsed(rows).length === rows.length;
  });
  const all = computed((): readonly T[] => parsed((rowsOf(state.value) ?? []).slice(0, MAX_COUNT)));
  const write = (entries: readonly T[]) =>
    state.set(entries.length === 0 ? "" : JSON.stringify(entries.map(rowOf)));
  const hasRoom = () => all.peek().length < MAX_COUNT;
  const add = (entry: T) => {
    if (!hasRoom()) return undefined;
    const before = all.peek();
    write([...before, entry]);
    return before.length;
  };
  return { all, write, hasRoom, add };
}

/** The rows of a text; undefined if it is no list. */
function rowsOf(text: string): unknown[] | undefined {
  if (text === "") return [];
  try {
    const rows: unknown = JSON.parse(text);
    return Array.isArray(rows) ? rows : undefined;
  } catch {
    return undefined;
  }
}

/** A coordinate as rows have it. */
export const short = (value: number): number => Number(value.toPrecision(DIGITS));
