import { useMemo, useState } from "preact/hooks";
import { kAxisRoom_px, measuredOf, profileX_mm, scaled, band } from "../../measured/measured";
import type { Block } from "../../net/block";
import { Plot } from "../../plot/Plot";
import type { Series, SeriesColour } from "../../plot/series";
import { fixed } from "../../ui/format";
import { Table, type Column } from "../../ui/Table";
import { Toggle } from "../../ui/Toggle";
import { mergeFault, merged, merging } from "./mergeState";
import { agreementWords, agrees, mergeKey, micro, strokeHeights_um, strokesOf, type MergedStroke } from "./merging";
import type { ProcessSection } from "./processing";

const kSigmas = 2;

const columns: Column<MergedStroke>[] = [
  { key: "name", label: "Stroke", cell: (row, index) => `${index + 1}\u00a0${row.name}` },
  { key: "direction", label: "Direction", cell: (row) => (row.used ? row.direction : "left out") },
  { key: "score", label: "Agreement", cell: agreementWords },
  { key: "shift", label: "Shift", unit: "mm", numeric: true, cell: (row) => (row.used ? fixed(1e3 * row.shift_m, 3) : "") },
  { key: "stretch", label: "Stretch", unit: "%", numeric: true, cell: (row) => (row.used ? fixed(100 * row.stretch, 2) : "") },
  { key: "coherence", label: "Coherence", numeric: true, cell: (row) => (row.used ? fixed(row.coherence, 3) : "") },
  { key: "noise", label: "Noise shown", unit: "µm", numeric: true, cell: (row) => (row.used ? micro(row.noise_rms_m) : "") },
  { key: "stated", label: "stated", unit: "µm", numeric: true, cell: (row) => (row.used ? micro(row.stated_noise_rms_m) : "") },
  { key: "weight", label: "Weight", numeric: true, cell: (row) => (row.used ? fixed(row.weight, 2) : "") },
];

/** The merged profile with its uncertainty, and the strokes on it. */
export function MergeView({ section }: { section: ProcessSection }) {
  const shown = merged.value;
  if (merging.value) return <p class="empty">Merging … The strokes are processed first.</p>;
  if (mergeFault.value) return <p class="empty" role="alert">The strokes could not be merged: {mergeFault.value}</p>;
  if (!shown) {
    return (
      <div class="page-empty">
        <h2>No merge yet</h2>
        <p>Choose recordings of several strokes over one line at the left, then merge. Their profiles are aligned and averaged, weighted by their noise.</p>
      </div>
    );
  }
  return (
    <div class="measured-column">
      {shown.key !== mergeKey(section) && <p class="measured-note" role="status">Strokes or settings were changed since. Merge again.</p>}
      {agrees(shown.block) && <MergePlot block={shown.block} />}
      <Table savable caption="The strokes of the merge" columns={columns} rows={strokesOf(shown.block)} rowKey={(row) => row.name} testId="merge-table" />
    </div>
  );
}

function MergePlot({ block }: { block: Block }) {
  const [apart, setApart] = useState(false);
  const measured = useMemo(() => measuredOf(block), [block]);
  const x = useMemo(() => profileX_mm(measured), [measured]);
  const series = useMemo<Series[]>(() => {
    const y = scaled(measured.array("profile_texture_m"), 1e6);
    const sigma = scaled(measured.array("profile_sigma_m"), 1e6);
    const own = apart ? new Float64Array(y.length) : y;
    const around = band(own, sigma, kSigmas);
    const mean: Series = { label: around ? `Merged ± ${kSigmas}σ` : "Merged", y: own, ...(around ?? {}), colour: "muted", width: 2 };
    const strokes = strokesOf(block);
    const each = strokeHeights_um(block, apart).flatMap((heights, index): Series[] =>
      strokes[index]!.used ? [{ label: `${index + 1} ${strokes[index]!.name}`, y: heights, colour: ((index % 8) + 1) as SeriesColour, width: 1 }] : [],
    );
    return [mean, ...each];
  }, [block, measured, apart]);
  return (
    <>
      <div class="measured-bar">
        <Toggle label="Differences from the merge" on={apart} onChange={setApart} testId="merge-apart" />
        <p class="measured-note">Each stroke is drawn at its aligned position, with its noise.</p>
      </div>
      <Plot
        label={apart ? "Differences of the strokes from the merged texture" : "The merged texture with the strokes on it"}
        x={x}
        series={series}
        xAxis={{ label: "Path length", unit: "mm" }}
        yAxis={{ label: apart ? "Difference" : "Texture", unit: "µm" }}
        yAxisRoom_px={kAxisRoom_px}
        empty="The strokes have no section in common."
        testId="plot-merge"
      />
    </>
  );
}
