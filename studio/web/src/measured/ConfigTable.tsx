import { Table } from "../ui/Table";
import { configRows, type Measured } from "./measured";

/** All settings as they were used, and the version that used them. */
export function ConfigTable({ measured }: { measured: Measured }) {
  return (
    <div class="measured-column">
      <p class="measured-note">Asperity {measured.version}. The same settings as text: result.json, "config".</p>
      <Table
        savable
        caption="Settings of this result"
        columns={[
          { key: "path", label: "Setting", cell: (row) => <code>{row.path}</code> },
          { key: "value", label: "Value", numeric: true },
        ]}
        rows={configRows(measured.config)}
        testId="config-used"
      />
    </div>
  );
}
