// What is kept in this browser of a workplace, and in no link: theme, paper, logo.

const PREFIX = "nurbs-hausdorff ";

/** What was kept under a name; undefined where nothing was, or the browser keeps nothing. */
export function kept(name: string): string | undefined {
  try {
    return localStorage.getItem(PREFIX + name) ?? undefined;
  } catch {
    return undefined;
  }
}

/** Keeps a text, or with an empty one nothing, as far as the browser does. */
export function keep(name: string, text: string): void {
  try {
    if (text === "") localStorage.removeItem(PREFIX + name);
    else localStorage.setItem(PREFIX + name, text);
  } catch {
    // It is as it was set until the page is closed.
  }
}
