// The state of the page in signals: the values of all controls that have a name, which links, undoing and
// kept files hold, each in one signal. What depends on them is computed from them, or is an effect.
import {
  batch,
  effect,
  type ReadonlySignal,
  type Signal,
  signal,
  untracked,
} from "@preact/signals-core";

export type Control = HTMLInputElement | HTMLSelectElement;

const values = new Map<string, Signal<string>>();

const isCheckBox = (control: Control): control is HTMLInputElement => control.type === "checkbox";

/** All controls that have a name. */
export const controls = (): Control[] => [
  ...document.querySelectorAll<Control>("input[name], select[name]"),
];

/** The value of a control, of a check box `on` or nothing. */
export function currentValue(control: Control): string {
  if (!isCheckBox(control)) return control.value;
  return control.checked ? "on" : "";
}

/** The signal of a control's value. */
function signalOf(control: Control): Signal<string> {
  const known = values.get(control.name);
  if (known !== undefined) return known;
  const made = signal(currentValue(control));
  values.set(control.name, made);
  return made;
}

// Before what listens to the control itself, which finds what follows from its value.
document.addEventListener(
  "input",
  ({ target }) => {
    const isControl = target instanceof HTMLInputElement || target instanceof HTMLSelectElement;
    if (isControl && target.name !== "") batch(() => refresh(target));
  },
  { capture: true },
);

/** Takes the value of a control that was set without an event. */
function refresh(control: Control): void {
  signalOf(control).value = currentValue(control);
}

/** A value of the form. */
export interface Field {
  /** The value of the control; effects and computed values that read it follow it. */
  readonly value: string;
  /** Sets the control, as if the user had. */
  set: (value: string) => void;
}

/**
 * The value of the control of this name.
 *
 * @throws {Error} if the page has no such control.
 */
export function field(name: string): Field {
  const control = controls().find((one) => one.name === name);
  if (control === undefined) throw new Error(`the page has no control of the name ${name}`);
  const own = signalOf(control);
  return {
    get value() {
      return own.value;
    },
    set(value) {
      if (currentValue(control) === value) return;
      put(control, value);
    },
  };
}

/** Whether what depends on a control knows its value: a browser that goes back fills controls without an event. */
export const isKnown = (control: Control): boolean =>
  signalOf(control).peek() === currentValue(control);

/** Whether a check box is checked. */
export const isOn = (box: Pick<Field, "value">): boolean => box.value === "on";

const checks = new Map<string, (value: string) => boolean>();

/** States which texts a field of text understands whole. */
export function understands(name: string, check: (value: string) => boolean): void {
  checks.set(name, check);
}

/** Whether a field understands all of a text; one without a check understands any. */
export const isUnderstood = (name: string, value: string): boolean =>
  checks.get(name)?.(value) ?? true;

/** Sets a control, and says so as the browser does when the user sets it. */
export function put(control: Control, value: string): void {
  if (isCheckBox(control)) control.checked = value === "on";
  else control.value = value;
  control.dispatchEvent(new Event("input", { bubbles: true }));
}

/** The number that is typed in a field; undefined where there is none, or one below 0. */
export function sizeOf(text: string): number | undefined {
  const value = Number(text);
  return text !== "" && Number.isFinite(value) && value >= 0 ? value : undefined;
}

/** Calls back whenever what is read changes, from the next change on. */
export function onChange<T>(read: () => T, callback: (value: T) => void): void {
  let isFirst = true;
  effect(() => {
    const value = read();
    if (isFirst) isFirst = false;
    else untracked(() => callback(value));
  });
}

export type { ReadonlySignal };
