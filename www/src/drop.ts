// Files chosen or dropped: the left half of the view is A, the right B.
import { element } from "./elements.ts";
import type { Side } from "./protocol.ts";

export function onFile(callback: (side: Side, name: string, text: string) => void): void {
  const take = async (side: Side, file: File | null | undefined) => {
    if (file) callback(side, file.name, await file.text());
  };
  for (const side of ["a", "b"] as const) {
    const input = element(`file-${side}`, HTMLInputElement);
    input.addEventListener("change", () => {
      void take(side, input.files?.[0]);
      input.value = "";
    });
    const label = input.closest("label");
    label?.addEventListener("dragover", (event) => event.preventDefault());
    label?.addEventListener("drop", (event) => {
      event.preventDefault();
      event.stopPropagation();
      void take(side, event.dataTransfer?.files[0]);
    });
  }
  const stage = element("stage");
  const overlay = element("drop");
  stage.addEventListener("dragover", (event) => {
    event.preventDefault();
    overlay.hidden = false;
  });
  stage.addEventListener("dragleave", () => {
    overlay.hidden = true;
  });
  stage.addEventListener("drop", (event) => {
    event.preventDefault();
    overlay.hidden = true;
    const [first, second] = Array.from(event.dataTransfer?.files ?? []);
    if (second) {
      void take("a", first);
      void take("b", second);
    } else void take(event.offsetX < stage.clientWidth / 2 ? "a" : "b", first);
  });
}
