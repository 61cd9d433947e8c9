import { millimetres } from "../ui/format";
import { Table } from "../ui/Table";
import type { Measured } from "./measured";

/** What was dropped, repaired or could not be had, and why; and the profile's gaps. */
export function DroppedTable({ measured }: { measured: Measured }) {
  return (
    <div class="measured-column">
      <Table
        savable
        caption="Data that were dropped or could not be computed, and the reason"
        columns={[
          { key: "count", label: "Number", numeric: true, cell: (row) => String(row.count) },
          { key: "message", label: "What was dropped, and the reason" },
          { key: "kind", label: "Name in result.json", cell: (row) => <code>{row.kind}</code> },
        ]}
        rows={measured.dropped}
        empty="Nothing was dropped."
        testId="dropped"
      />
      <Table
        savable
        caption="Gaps of the profile"
        columns={[
          { key: "from", label: "Gap from", numeric: true, cell: (row) => millimetres(row.from_m) },
          { key: "to", label: "to", numeric: true, cell: (row) => millimetres(row.to_m) },
          { key: "why", label: "Reason" },
        ]}
        rows={measured.gaps}
        empty="The profile has no gaps."
        testId="gaps"
      />
      {measured.gapCount > measured.gaps.length && (
        <p class="measured-note">
          {measured.gaps.length} of {measured.gapCount} gaps are listed.
        </p>
      )}
    </div>
  );
}
