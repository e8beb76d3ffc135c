// The buttons that export the result.
import { element } from "../common/elements.ts";

const FORMATS = ["json", "csv", "png", "gltf", "report", "pages"] as const;

export type ExportFormat = (typeof FORMATS)[number];

const note = element("export-note");

/** Calls back with the format of a button; failures are shown below the buttons. */
export function onExport(callback: (format: ExportFormat) => Promise<void> | void): void {
  for (const format of FORMATS) {
    const button = element(`export-${format}`, HTMLButtonElement);
    button.addEventListener("click", async () => {
      note.textContent = "";
      try {
        await callback(format);
      } catch (error) {
        note.textContent = error instanceof Error ? error.message : `${error}`;
      }
    });
  }
}
