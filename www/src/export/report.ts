// A report to print: picture, interval, verdict, settings, statistics and histogram.
import { element } from "../common/elements.ts";

const STYLE = `
  body { font: 14px/1.45 system-ui, sans-serif; max-width: 46rem; margin: 2rem auto; color: #16202b; }
  img { width: 100%; border: 1px solid #d9e1e8; border-radius: 6px; }
  h1 { font-size: 1.3rem; } h2 { font-size: 1rem; margin: 1.2rem 0 0.3rem; }
  dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 1.5rem; margin: 0; }
  dt { color: #55646f; } dd { margin: 0; }
  svg { width: 100%; height: 90px; border-bottom: 1px solid #d9e1e8; }
  #scale { height: 12px; } #scale-ends { display: flex; justify-content: space-between; }
  @media print { body { margin: 0; } }
`;

/** What the report contains besides what the page shows. */
export interface ReportContent {
  /** The address of the picture. */
  picture: string;
  /** Terms and texts of the settings. */
  settings: readonly (readonly [term: string, text: string])[];
  /** The summary of the deviation, if there is one. */
  deviation: HTMLElement | undefined;
}

/** Returns the report as a page of its own, which needs nothing else. */
export function reportOf({ picture, settings, deviation }: ReportContent): Blob {
  const page = document.implementation.createHTMLDocument("Hausdorff distance: report");
  page.documentElement.lang = "en";
  const style = page.createElement("style");
  style.textContent = STYLE;
  page.head.append(style);
  const image = page.createElement("img");
  image.src = picture;
  image.alt = "The two models and the arrow between the points that attain the distance";
  page.body.append(
    heading(page, "h1", `${text("kind")}: ${text("distance")} ${text("unit")}`),
    paragraph(page, `${text("interval")} ${text("width")}`),
    paragraph(page, text("verdict")),
    image,
    heading(page, "h2", "Settings"),
    terms(page, settings),
    heading(page, "h2", "Details"),
    page.importNode(element("facts"), true),
  );
  if (deviation !== undefined) {
    page.body.append(
      heading(page, "h2", "Deviation over A’s area (estimates)"),
      page.importNode(deviation, true),
      page.importNode(element("scale"), true),
      page.importNode(element("scale-ends"), true),
    );
  }
  if (text("face-summary") !== "") {
    page.body.append(
      heading(page, "h2", "Changed faces"),
      page.importNode(element("face-summary"), true),
    );
  }
  page.body.append(paragraph(page, `Made ${new Date().toLocaleString("en")} · ${text("engine")}`));
  return new Blob(["<!doctype html>\n", page.documentElement.outerHTML], { type: "text/html" });
}

const text = (id: string): string => element(id).textContent ?? "";

function heading(page: Document, name: "h1" | "h2", content: string): HTMLElement {
  const node = page.createElement(name);
  node.textContent = content;
  return node;
}

function paragraph(page: Document, content: string): HTMLElement {
  const node = page.createElement("p");
  node.textContent = content;
  return node;
}

function terms(page: Document, all: ReportContent["settings"]): HTMLElement {
  const list = page.createElement("dl");
  for (const [term, content] of all) {
    const [dt, dd] = [page.createElement("dt"), page.createElement("dd")];
    dt.textContent = term;
    dd.textContent = content;
    list.append(dt, dd);
  }
  return list;
}
