import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Table, type Column } from "../../ui/Table";
import { Toggle } from "../../ui/Toggle";
import { align, colouring, opened, placed, residuals, result, showing, showAreas, showOverlaps, type Colouring } from "./alignState";
import { overlapByPath, rmsByPath, rotationDegrees, scanRows, type ScanRow, type StoredScan } from "./scans";

const shift_mm = (row: ScanRow, axis: number) => (row.T_mesh_world ? (1e3 * row.T_mesh_world[axis]!).toFixed(2) : "");

const columns: Column<ScanRow>[] = [
  {
    key: "name",
    label: "Scan",
    cell: (row) => (
      <span class="align-scan" title={row.name}>
        <span class="align-swatch" style={{ background: `var(--series-${row.colour})` }} />
        {row.name}
      </span>
    ),
  },
  { key: "where", label: "State" },
  { key: "placement", label: "Placement", numeric: true, cell: (row) => row.placement ?? "" },
  { key: "x", label: "x", unit: "mm", numeric: true, cell: (row) => shift_mm(row, 0) },
  { key: "y", label: "y", unit: "mm", numeric: true, cell: (row) => shift_mm(row, 1) },
  { key: "z", label: "z", unit: "mm", numeric: true, cell: (row) => shift_mm(row, 2) },
  { key: "rotation", label: "Rotation", unit: "°", numeric: true, cell: (row) => (row.T_mesh_world ? rotationDegrees(row.T_mesh_world).toFixed(2) : "") },
  { key: "rms", label: "Residual, RMS", unit: "mm", numeric: true, cell: (row) => (row.rms_m == null || !Number.isFinite(row.rms_m) ? "" : (1e3 * row.rms_m).toFixed(3)) },
  { key: "overlap", label: "Overlap", unit: "%", numeric: true, cell: (row) => (row.overlap == null || !Number.isFinite(row.overlap) ? "" : (100 * row.overlap).toFixed(0)) },
  { key: "verdict", label: "Verdict", cell: (row) => row.verdict ?? "" },
];

const kColourings: { value: Colouring; label: string }[] = [
  { value: "distance", label: "Distance to the mesh" },
  { value: "sigma", label: "Distance over its σ" },
  { value: "scan", label: "Scan" },
];

/** The scans that are registered here and those that the scene has, with their poses and verdicts. */
export function ScansPanel() {
  const section = align.value;
  const block = opened.value;
  if (!section || !block) return null;
  const stored = (block.head.stored ?? []) as StoredScan[];
  const now = residuals.value;
  const rms_m = now ? rmsByPath(now.distance_m, block.arrays.path_of ?? [], section.paths.length) : [];
  const found = showing.value === "best" ? (result.value?.scans ?? null) : null;
  const overlap = now ? overlapByPath(now.overlap, block.arrays.path_of ?? [], section.paths.length) : [];
  const rows = scanRows(section.paths, found, placed.value, rms_m, stored, overlap);
  return (
    <Panel title="Scans" testId="align-scans">
      <Table savable caption="Scans with their poses" columns={columns} rows={rows} rowKey={(row) => row.key} empty="No scan is chosen." testId="align-scan-table" />
      <Select label="Colour of the paths" value={colouring.value} options={kColourings} onChange={(by) => (colouring.value = by as Colouring)} testId="align-colouring" />
      <Toggle label="Mark overlaps" on={showOverlaps.value} onChange={(on) => (showOverlaps.value = on)} testId="align-mark-overlaps" />
      {(block.shapes.laid_triangle?.[0] ?? 0) > 0 && (
        <>
          <Toggle label="Show textured areas" on={showAreas.value} onChange={(on) => (showAreas.value = on)} testId="align-areas" />
          <p class="field-hint" data-testid="align-overlap">
            {block.shapes.laid_triangle![0]} triangles have a texture, {block.shapes.covered_triangle?.[0] ?? 0} of them several. These are drawn dark.
          </p>
        </>
      )}
    </Panel>
  );
}
