import { useMemo } from "preact/hooks";
import { Plot } from "../plot/Plot";
import type { Series } from "../plot/series";
import { kAxisRoom_px, profileX_mm, scaled, type Measured } from "./measured";

const QUANTITIES = {
  force: { array: "profile_force_N", label: "Force", unit: "N", factor: 1, colour: 2 },
  speed: { array: "profile_speed_mps", label: "Speed", unit: "mm/s", factor: 1e3, colour: 3 },
} as const;

/** Force or speed over the path length. */
export function WayPlot({ measured, what }: { measured: Measured; what: keyof typeof QUANTITIES }) {
  const { array, label, unit, factor, colour } = QUANTITIES[what];
  const x = useMemo(() => profileX_mm(measured), [measured]);
  const series = useMemo<Series[]>(() => [{ label, y: scaled(measured.array(array), factor), colour }], [measured, what]);
  return (
    <Plot
      label={`${label} along the path`}
      x={x}
      series={series}
      xAxis={{ label: "Path length", unit: "mm" }}
      yAxis={{ label, unit }}
      syncKey="profile"
      yAxisRoom_px={kAxisRoom_px}
      testId={`plot-${what}`}
    />
  );
}
