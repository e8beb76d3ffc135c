const ENTITIES: Readonly<Record<string, string>> = {
  "&": "&amp;",
  "<": "&lt;",
  ">": "&gt;",
  '"': "&quot;",
  "'": "&apos;",
};

/** The text as it stands in XML and HTML. */
export const escapeXml = (text: string): string =>
  text.replace(/[&<>"']/g, (character) => ENTITIES[character] ?? character);

/** The text with a backslash before each character that Markdown could take for a mark. */
export const escapeMarkdown = (text: string): string =>
  text.replace(/[\n\r]/g, " ").replace(/[\\`*_[\]<>|&~#]/g, "\\$&");
