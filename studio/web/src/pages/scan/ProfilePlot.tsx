import { computed } from "@preact/signals";
import { useMemo, useState } from "preact/hooks";
import { Plot } from "../../plot/Plot";
import type { Series } from "../../plot/series";
import { Button } from "../../ui/Button";
import { Panel } from "../../ui/Panel";
import { band } from "./growing";
import { isLiveUsable } from "./scanState";
import { profile, profileVersion, refined, state } from "./stream";

// While the next segment is made, the refined one is another's.
const storing = computed(() => state.value?.recorder?.storing ?? false);

type Shown = "texture_m" | "height_m";

/** The causal profile as it grows, and the refined one when the scan has ended. */
export function ProfilePlot() {
  const [shown, setShown] = useState<Shown>("texture_m");
  const version = profileVersion.value;
  const last = storing.value ? null : refined.value;
  const series = useMemo<Series[]>(() => {
    const live = profile.columns;
    const y = live[shown].values;
    const arrays = last?.arrays;
    // The refined way begins where the path does; the live one is laid onto it.
    const shift_mm = 1e3 * (arrays?.s_m ? (last!.head.difference?.shift_m ?? 0) : 0);
    const out: Series[] = [];
    // A live profile that had too little data is not shown with the refined one.
    if (y.length > 0 && (!arrays?.s_m || isLiveUsable(last!.head.difference)))
      out.push({ label: "while scanning", x: shift_mm === 0 ? live.s_m.values : live.s_m.values.map((s_mm) => s_mm + shift_mm), y, ...band(y, live.sigma_m.values), colour: 2 });
    if (arrays?.s_m) {
      const micrometres = (values: ArrayLike<number>) => Float64Array.from(values, (value) => value * 1e6);
      const heights = micrometres(arrays[shown]!);
      out.push({
        label: "refined",
        x: Float64Array.from(arrays.s_m, (s_m) => s_m * 1e3),
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
        <>
          <Button kind="quiet" pressed={shown === "texture_m"} onClick={() => setShown("texture_m")} hint="The height after the high-pass" testId="scan-shown-texture">
            texture
          </Button>
          <Button kind="quiet" pressed={shown === "height_m"} onClick={() => setShown("height_m")} hint="Only the base shape is removed" testId="scan-shown-height">
            height
          </Button>
        </>
      }
    >
      <Plot label="Surface profile along the path" series={series} xAxis={{ label: "along the path", unit: "mm" }} yAxis={{ label: "height", unit: "µm" }}
        empty="The profile grows here while you scan." testId="scan-profile-plot" legend />
    </Panel>
  );
}
