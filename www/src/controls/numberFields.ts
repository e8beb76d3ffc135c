// Fields of numbers: a decimal comma is a point, and what is no number of the field's range is marked.

const isNumberField = (target: EventTarget | null): target is HTMLInputElement =>
  target instanceof HTMLInputElement && target.type === "number";

/** Listens to all fields of numbers of the page. */
export function connectNumberFields(): void {
  // Browsers drop a comma that is not of their language without a word: 0,2 would become 02.
  document.addEventListener(
    "beforeinput",
    (event) => {
      const { target, data } = event;
      if (!isNumberField(target) || !data?.includes(",")) return;
      event.preventDefault();
      // The one way to type for the user that a field of numbers has; undoing takes it back.
      document.execCommand("insertText", false, data.replaceAll(",", "."));
    },
    { capture: true },
  );
  document.addEventListener("input", ({ target }) => {
    if (isNumberField(target)) target.setAttribute("aria-invalid", `${!target.validity.valid}`);
  });
}
