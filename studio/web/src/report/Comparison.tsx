import { Table } from "../ui/Table";
import { comparedRows, type ComparedRow } from "./compare";
import type { Result } from "./result";

/** The values of several results side by side. */
export function Comparison({ results }: { results: Result[] }) {
  const rows = comparedRows(results.map((result) => result.measured.figures));
  return (
    <section class="report-drawing report-compared" aria-label="Side by side">
      <h2>Side by side</h2>
      <Table<ComparedRow>
        savable
        caption="Metrics of all results"
        columns={[
          { key: "group", label: "Group", cell: (row: ComparedRow, index: number) => (rows[index - 1]?.group === row.group ? "" : row.group) },
          { key: "label", label: "Metric" },
          ...results.map((result, index) => ({ key: `${index}`, label: result.name, numeric: true, cell: (row: ComparedRow) => row.values[index] ?? "–" })),
        ]}
        rows={rows}
      />
    </section>
  );
}
