import { useMemo, useState } from "preact/hooks";
import { Plot } from "../../plot/Plot";
import type { Series } from "../../plot/series";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { band } from "./growing";
import { isLiveUsable } from "./scanState";
import { profile, profileVersion, refined } from "./stream";

type Shown = "texture_m" | "height_m";

/** The causal profile as it grows, and the refined one when the scan has ended. */
export function ProfilePlot() {
  const [shown, setShown] = useState<Shown>("texture_m");
  const version = profileVersion.value;
  const last = refined.value;
  const series = useMemo<Series[]>(() => {
    const live = profile.columns;
    const y = live[shown].values;
    const arrays = last?.arrays;
    const out: Series[] = [];
    // A live profile that had too little to go by is of no use beside the refined one.
    if (!arrays?.s_m || isLiveUsable(last!.head.difference))
      out.push({ label: "while scanning", x: live.s_m.values, y, ...band(y, live.sigma_m.values), colour: 2 });
    if (arrays?.s_m) {
      const shift_m: number = last!.head.difference?.shift_m ?? 0;
      const micrometres = (values: ArrayLike<number>) => Float64Array.from(values, (value) => value * 1e6);
      const heights = micrometres(arrays[shown]!);
      out.push({
        label: "refined",
        x: Float64Array.from(arrays.s_m, (s_m) => (s_m - shift_m) * 1e3),
        y: heights,
        ...band(heights, micrometres(arrays.sigma_m!)),
        colour: 1,
      });
    }
    return out;
  }, [version, last, shown]);
  return (
    <Panel
      title="Profile"
      grow
      testId="scan-profile"
      actions={
        <Select label="Shown" value={shown} testId="scan-shown" onChange={(value) => setShown(value as Shown)}
          options={[{ value: "texture_m", label: "Texture" }, { value: "height_m", label: "Height" }]} />
      }
    >
      <Plot label="Surface profile along the path" series={series} xAxis={{ label: "along the path", unit: "mm" }} yAxis={{ label: "height", unit: "µm" }}
        empty="The profile grows here while you scan." testId="scan-profile-plot" legend />
    </Panel>
  );
}
