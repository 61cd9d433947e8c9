import { useMemo } from "preact/hooks";
import { Plot } from "../../plot/Plot";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { Panel } from "../../ui/Panel";
import { residuals } from "./alignState";
import { colourLimit_m, histogram } from "./residuals";

/** How far the path that is shown is from the mesh. */
export function ResidualPanel() {
  const now = residuals.value;
  const bars = useMemo(() => (now ? histogram(now.distance_m, colourLimit_m(now.distance_m)) : null), [now]);
  return (
    <Panel title="Distances" testId="align-distances">
      <Figures>
        <Figure label="Mean" value={now?.mean_m} factor={1e3} unit="mm" digits={3} testId="align-mean" />
        <Figure label="RMS" value={now?.rms_m} factor={1e3} unit="mm" digits={3} />
        <Figure label="Maximum" value={now?.most_m} factor={1e3} unit="mm" digits={3} />
        <Figure label="σ of a distance, median" value={now?.median_sigma_m} factor={1e3} unit="mm" digits={3} hint="As the scans state it, without the error of the pose and the relief" />
        <Figure label="RMS over σ" value={now?.rms_sigma} digits={3} hint="About 1 on a smooth mesh that fits; a relief makes it larger" testId="align-rms-sigma" />
      </Figures>
      <div class="align-histogram">
        <Plot
          key={bars?.edges_mm[0]}
          label="Histogram of the distances, negative inside the mesh"
          x={bars?.edges_mm ?? []}
          series={[{ label: "points", y: bars?.percent ?? [], kind: "step", colour: 1 }]}
          xAxis={{ label: "inside − / + outside", unit: "mm" }}
          yAxis={{ label: "share", unit: "%" }}
          legend={false}
          empty="No path and mesh are open."
        />
      </div>
    </Panel>
  );
}
