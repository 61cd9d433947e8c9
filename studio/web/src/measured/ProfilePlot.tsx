import { useMemo } from "preact/hooks";
import { Plot } from "../plot/Plot";
import type { Series } from "../plot/series";
import { band, kAxisRoom_px, profileX_mm, scaled, type Measured } from "./measured";

const kSigmas = 2;

export interface ProfilePlotProps {
  measured: Measured;
  /** "height": the base shape removed; "texture": the same after the high-pass. */
  what: "height" | "texture";
  syncKey?: string;
}

/** Height or texture over the path length, with its uncertainty; gaps are gaps. */
export function ProfilePlot({ measured, what, syncKey = "profile" }: ProfilePlotProps) {
  const x = useMemo(() => profileX_mm(measured), [measured]);
  const series = useMemo<Series[]>(() => {
    const y = scaled(measured.array(`profile_${what}_m`), 1e6);
    const around = band(y, scaled(measured.array("profile_sigma_m"), 1e6), kSigmas);
    const label = what === "height" ? "Height" : "Texture";
    return [{ label: around ? `${label} ± ${kSigmas}σ` : label, y, ...(around ?? {}), colour: 1 }];
  }, [measured, what]);
  return (
    <Plot
      label={what === "height" ? "Height over the base shape along the path" : "Texture, the high-passed height, along the path"}
      x={x}
      series={series}
      xAxis={{ label: "Path length", unit: "mm" }}
      yAxis={{ label: what === "height" ? "Height" : "Texture", unit: "µm" }}
      syncKey={syncKey}
      empty="No profile. The tab Dropped states the reason."
      yAxisRoom_px={kAxisRoom_px}
      testId={`plot-${what}`}
      legend
    />
  );
}
