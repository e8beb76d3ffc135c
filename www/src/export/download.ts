// Files that the page makes.

import { texts } from "../texts/index.ts";
/** Offers a file to the user, who saves it. */
export function download(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  // The browser reads the file after this task.
  setTimeout(() => URL.revokeObjectURL(link.href), REVOKE_DELAY);
}

/**
 * Shows a page in a tab of its own, which is opened before the page is made: a browser opens none
 * that comes long after a click. Where it opens none at all, the page is saved as a file.
 *
 * @throws {Error} that says so, where the page was saved.
 */
export async function openMade(name: string, make: () => Promise<Blob>): Promise<void> {
  const tab = window.open("", "_blank");
  tab?.document.body.append(texts.report.theReportIsBeingMade);
  try {
    const page = await make();
    // As long as this page is open, the tab can be loaded again.
    if (tab !== null) tab.location.replace(URL.createObjectURL(page));
    else {
      download(name, page);
      throw new Error(texts.report.theBrowserOpensNoTab);
    }
  } catch (error) {
    tab?.close();
    throw error;
  }
}

/** Milliseconds after which a browser has certainly started to read a file. */
const REVOKE_DELAY = 60_000;

/** Returns the picture of a canvas that was drawn in this task. */
export function pictureOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => {
      if (blob === null) reject(new Error(texts.report.thePictureCouldNotBe));
      else resolve(blob);
    }, "image/png");
  });
}

/** Returns the bytes as an address, which a file can contain. */
export function dataUrl(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(`${reader.result}`);
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}
