import { useMemo, useState } from "preact/hooks";
import type { Block } from "../net/block";
import { Plot } from "../plot/Plot";
import type { Series, SeriesColour } from "../plot/series";
import { number } from "../ui/format";
import { Table } from "../ui/Table";
import { Toggle } from "../ui/Toggle";
import { figureWords, scaled, type MeasuredFigure } from "./measured";
import { colourRange } from "./pathColours";
import { repeatedRows, type RepeatedScan } from "./repeated";

/** Profiles of several scans over one another, each shifted once, and how far they agree (thesis Fig. 30). */
export function RepeatabilityPlot({ block }: { block: Block }) {
  const [stacked, setStacked] = useState(true);
  const scans: RepeatedScan[] = block.head.scans;
  const x = useMemo(() => scaled(block.arrays.s_m!, 1e3), [block]);
  const series = useMemo<Series[]>(() => {
    const heights = scaled(block.arrays.height_m!, 1e6);
    const step = stacked ? spacing(heights) : 0;
    const each = scans.map((scan, index): Series => ({
      label: `${index + 1} ${scan.name}`,
      y: heights.subarray(index * x.length, (index + 1) * x.length).map((height) => height - index * step),
      colour: ((index % 8) + 1) as SeriesColour,
      width: 1.2,
    }));
    if (stacked) return each;
    const mean: Series = {
      label: "Mean ± standard deviation",
      y: scaled(block.arrays.mean_m!, 1e6),
      lo: scaled(block.arrays.low_m!, 1e6),
      hi: scaled(block.arrays.high_m!, 1e6),
      colour: "muted",
      width: 2,
    };
    return [mean, ...each];
  }, [block, stacked]);
  const spread = (block.head.figures as MeasuredFigure[]).find((one) => one.key === "spread_rms_m");
  const [low, high] = block.head.band_cycles_per_mm as [number, number];
  return (
    <div class="measured-column">
      <div class="measured-bar">
        <Toggle label="Stacked" on={stacked} onChange={setStacked} testId="stacked" />
        <p class="measured-note">
          Band {number(low, 2)} to {number(high, 3)}{"\u202f"}cycles/mm. Each scan is shifted as a whole to match the first. {spread && `Spread of the heights: ${figureWords(spread)} RMS.`}
        </p>
      </div>
      <Plot
        label={`Profiles of ${scans.length} scans, aligned`}
        x={x}
        series={series}
        xAxis={{ label: "Path length of the first", unit: "mm" }}
        yAxis={{ label: stacked ? "Height in the band, shifted" : "Height in the band", unit: "µm" }}
        empty="The profiles have no section in common."
        testId="plot-repeatability"
      />
      <Table
        savable
        caption="The scans, their agreement with the first, and the mean of all with its standard deviation"
        columns={[
          { key: "name", label: "Scan", cell: (row, index) => (index < scans.length ? `${index + 1}\u00a0${row.name}` : <strong>{row.name}</strong>) },
          { key: "correlation", label: "Correlation", numeric: true },
          { key: "rms_um", label: "Diff.", unit: "µm RMS", numeric: true },
          { key: "shift_mm", label: "Shift", unit: "mm", numeric: true },
          { key: "pitch_mm", label: "Pitch", unit: "mm", numeric: true },
          { key: "depth_um", label: "Depth", unit: "µm", numeric: true },
        ]}
        rows={repeatedRows(scans, block.head.figures)}
        testId="repeated-scans"
      />
    </div>
  );
}

/** How far apart profiles stand so that they can be distinguished: what all but a hundredth of the heights span. */
function spacing(heights: Float64Array): number {
  const range = colourRange(heights);
  return range ? range.high - range.low : 0;
}
