// The colours of the style sheet.

/** Returns a colour of the style sheet. */
export const cssColor = (name: "a" | "b" | "accent"): string =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
