// The texts of pages in place of their names in braces.
import { pageTexts, texts } from "./index.ts";

/**
 * Returns the page with its texts, whose marks of HTML stay.
 *
 * @throws {Error} where a page names a text that there is not.
 */
export function filled(html: string): string {
  const spoken = html.replace('<html lang="en">', `<html lang="${texts.language}">`);
  return spoken.replace(/\{\{([\w.]+)\}\}/g, (name, path: string) => {
    const text = textAt(path);
    if (text === undefined) throw new Error(`a page names ${name}, which is no text`);
    return text.replace(/&(?!\w+;)/g, "&amp;").replaceAll('"', "&quot;");
  });
}

function textAt(path: string): string | undefined {
  const [page = "", key = ""] = path.split(".");
  const pages: Readonly<Record<string, Readonly<Record<string, string>>>> = pageTexts;
  return pages[page]?.[key];
}
