// The report's style: pages on which no figure and no row is broken.

/** The papers, with the width of what is between their margins. */
const WIDTHS = { A4: "178mm", letter: "184mm" } as const;

export type Paper = keyof typeof WIDTHS;

/** Returns the style for a paper. */
export const styleFor = (paper: Paper): string => `
  @page { size: ${paper}; margin: 16mm; }
  body { font: 13px/1.45 system-ui, sans-serif; max-width: ${WIDTHS[paper]}; margin: 2rem auto; padding: 0 1rem; color: #16202b; background: white; }
  h1 { font-size: 1.4rem; margin: 0 0 .4rem; } h2 { font-size: 1.05rem; margin: 1.4rem 0 .4rem; break-after: avoid; }
  header { display: flex; justify-content: space-between; gap: 8mm; align-items: start; }
  header img { max-height: 16mm; max-width: 60mm; }
  figure, tr, dl, .card { break-inside: avoid; }
  .card { border: 2px solid #55646f; border-radius: 8px; padding: .6rem 1rem; margin: .8rem 0; }
  .card[data-verdict="pass"] { border-color: #0f7038; } .card[data-verdict="fail"] { border-color: #b3142f; }
  .card[data-verdict="undecided"] { border-color: #8a4b00; }
  .badge { font-size: 1.5rem; font-weight: 700; margin-right: .6rem; }
  [data-verdict="pass"] .badge { color: #0f7038; } [data-verdict="fail"] .badge { color: #b3142f; } [data-verdict="undecided"] .badge { color: #8a4b00; }
  dl { display: grid; grid-template-columns: max-content 1fr; gap: 1px 1.2rem; margin: 0; }
  dt { color: #55646f; } dd { margin: 0; overflow-wrap: anywhere; }
  figure { margin: .6rem 0; } figcaption { font-weight: 600; margin-bottom: .2rem; }
  .view { display: grid; grid-template-columns: minmax(0, 1fr) 34mm; gap: 4mm; align-items: center; }
  .view img { width: 100%; border: 1px solid #d9e1e8; border-radius: 4px; }
  .places { display: grid; grid-template-columns: 1fr 1fr; gap: 4mm; } .places img { width: 100%; border: 1px solid #d9e1e8; border-radius: 4px; }
  svg { width: 100%; } svg text { font-size: 12px; fill: #16202b; } .legend text { font-size: 11px; }
  table { border-collapse: collapse; width: 100%; } thead { display: table-header-group; }
  th, td { text-align: left; padding: 2px 6px; border-bottom: 1px solid #d9e1e8; } .number { text-align: right; font-variant-numeric: tabular-nums; }
  footer { margin-top: 1.5rem; color: #55646f; }
  .screen { text-align: right; margin: 0; } .screen button { font: inherit; padding: .3rem .8rem; }
  @media print { .screen { display: none; } body { margin: 0; padding: 0; max-width: none; } }
`;
