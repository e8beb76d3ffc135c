// What a panel shows as a table, for the report.

export interface ReportTable {
  title: string;
  head: readonly string[];
  rows: readonly (readonly string[])[];
}
