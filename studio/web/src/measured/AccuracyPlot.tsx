import { useMemo } from "preact/hooks";
import { Plot } from "../plot/Plot";
import type { Series } from "../plot/series";
import { scaled, type Measured } from "./measured";

/** The measured profile with the true one, aligned, in the band in which they are compared (thesis Fig. 31). */
export function AccuracyPlot({ measured }: { measured: Measured }) {
  const x = useMemo(() => scaled(measured.array("compared_s_m"), 1e3), [measured]);
  const series = useMemo<Series[]>(
    () =>
      x.length === 0
        ? []
        : [
            { label: "True", y: scaled(measured.array("compared_true_m"), 1e6), colour: "muted", width: 3 },
            { label: "Measured", y: scaled(measured.array("compared_measured_m"), 1e6), colour: 2 },
          ],
    [measured, x],
  );
  return (
    <Plot
      label="Measured and true profile, aligned and with the same band-pass"
      x={x}
      series={series}
      xAxis={{ label: "Path length of the truth", unit: "mm" }}
      yAxis={{ label: "Height in the band", unit: "µm" }}
      empty="This recording has no truth. Only simulated recordings and those of a known artefact have one."
      testId="plot-accuracy"
    />
  );
}
