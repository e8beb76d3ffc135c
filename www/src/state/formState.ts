// The values of all controls that have a name, as the text of the page's address.
import { batch } from "@preact/signals-core";
import { type Control, controls, currentValue, isKnown, isUnderstood, put } from "./store.ts";

/** Returns the values that differ from the page's own, as parameters of an address. */
export function formState(): string {
  const parameters = new URLSearchParams();
  for (const control of controls()) {
    const value = currentValue(control);
    if (value !== defaultOf(control)) parameters.set(control.name, value);
  }
  return parameters.toString();
}

/** Sets all controls but those excluded; each that changes raises its events, and what follows from all is done once. */
export function applyFormState(text: string, excluded: readonly string[] = []): void {
  const parameters = new URLSearchParams(text);
  batch(() => {
    for (const control of controls()) {
      if (excluded.includes(control.name)) continue;
      const value = parameters.get(control.name) ?? defaultOf(control);
      const isThere = value === currentValue(control) && isKnown(control);
      if (!isThere && takes(control, value)) put(control, value);
    }
  });
}

/** The parameters of an address, apart from `others`, of which no control has the name or takes all of the value. */
export function notUnderstood(text: string, others: readonly string[]): string[] {
  const all = new Map(controls().map((control) => [control.name, control]));
  return [...new URLSearchParams(text)].flatMap(([name, value]) => {
    const control = all.get(name);
    const isRead = control !== undefined && takes(control, value) && isUnderstood(name, value);
    return isRead || others.includes(name) ? [] : [name];
  });
}

/** Whether a control can have a value: an address may hold anything. */
function takes(control: Control, value: string): boolean {
  if (control instanceof HTMLSelectElement) {
    return [...control.options].some((option) => option.value === value);
  }
  const isNumber = control.type === "number" || control.type === "range";
  return !isNumber || value === "" || Number.isFinite(Number(value));
}

/** The value that the page begins with; a list of models has none. */
function defaultOf(control: Control): string {
  if (control instanceof HTMLInputElement) {
    if (control.type !== "checkbox") return control.defaultValue;
    return control.defaultChecked ? "on" : "";
  }
  if (control.dataset.models !== undefined) return "";
  const options = [...control.options];
  return (options.find((option) => option.defaultSelected) ?? options[0])?.value ?? "";
}
