// The values of all controls that have a name, as the text of the page's address.

type Control = HTMLInputElement | HTMLSelectElement;

const controls = (): Control[] => [
  ...document.querySelectorAll<Control>("input[name], select[name]"),
];

/** Returns the values that differ from the page's own, as parameters of an address. */
export function formState(): string {
  const parameters = new URLSearchParams();
  for (const control of controls()) {
    const value = currentValue(control);
    if (value !== defaultOf(control)) parameters.set(control.name, value);
  }
  return parameters.toString();
}

/** Sets all controls but those excluded; each that changes raises its events. */
export function applyFormState(text: string, excluded: readonly string[] = []): void {
  const parameters = new URLSearchParams(text);
  for (const control of controls()) {
    if (excluded.includes(control.name)) continue;
    const value = parameters.get(control.name) ?? defaultOf(control);
    if (value === currentValue(control) || !takes(control, value)) continue;
    if (control instanceof HTMLInputElement && isCheckBox(control))
      control.checked = value === "on";
    else control.value = value;
    control.dispatchEvent(new Event("input", { bubbles: true }));
  }
}

/** Whether a control can have a value: an address may hold anything. */
function takes(control: Control, value: string): boolean {
  if (control instanceof HTMLSelectElement) {
    return [...control.options].some((option) => option.value === value);
  }
  const isNumber = control.type === "number" || control.type === "range";
  return !isNumber || value === "" || Number.isFinite(Number(value));
}

const isCheckBox = (control: Control): boolean => control.type === "checkbox";

const switched = (on: boolean): string => (on ? "on" : "");

function currentValue(control: Control): string {
  if (control instanceof HTMLSelectElement || !isCheckBox(control)) return control.value;
  return switched(control.checked);
}

/** The value that the page begins with; a list of models has none. */
function defaultOf(control: Control): string {
  if (control instanceof HTMLInputElement) {
    return isCheckBox(control) ? switched(control.defaultChecked) : control.defaultValue;
  }
  if (control.dataset.models !== undefined) return "";
  const options = [...control.options];
  return (options.find((option) => option.defaultSelected) ?? options[0])?.value ?? "";
}
