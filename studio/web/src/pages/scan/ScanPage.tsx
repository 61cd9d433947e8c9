import { useEffect, useMemo, useState } from "preact/hooks";
import { call } from "../../net/connection";
import { LivePlot } from "../../plot/LivePlot";
import type { ConfigField } from "../../ui/ConfigForm";
import { useKeys } from "../../ui/keys";
import { PageLayout } from "../../ui/PageLayout";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import { CameraImage } from "./CameraImage";
import { discard, rescan, restore, segment, startOrStop, toggleAuto } from "./commands";
import { GuidePanel } from "./GuidePanel";
import { HintsPanel } from "./HintsPanel";
import { ProfilePlot } from "./ProfilePlot";
import { RecordPanel } from "./RecordPanel";
import { ResultPanel } from "./ResultPanel";
import { ScanView } from "./ScanView";
import { SegmentsPanel } from "./SegmentsPanel";
import { SensorsPanel } from "./SensorsPanel";
import { scan, withSettings } from "./settings";
import { SourcePanel } from "./SourcePanel";
import { acceleration, figures, follow, force, state } from "./stream";
import { TuningPanel } from "./TuningPanel";
import "./scan.css";

/** Not while a control has the focus: a key that takes out is not to be hit by chance. */
const away = (run: () => unknown) => () => (document.activeElement?.matches("input, select, button, textarea") ? undefined : run());

const kWindow_s = 6;
const FORCE = [{ label: "force", colour: 1 as const }];
const ACCELERATION = [
  { label: "x", colour: 2 as const },
  { label: "y", colour: 3 as const },
  { label: "z", colour: 4 as const },
];

/** Record a surface and watch its profile grow (thesis Fig. 7 and §7.2). */
export default function ScanPage() {
  const [known, setKnown] = useState<ConfigField[]>([]);
  useEffect(follow, []);
  useEffect(() => void call<ConfigField[]>("scan.fields").then(setKnown).catch(complain), []);
  const settings = scan.value.settings;
  const fields = useMemo(() => withSettings(known, settings), [known, settings]);
  useKeys([
    { key: "space", label: "start or stop recording", run: startOrStop },
    { key: "s", label: "end the segment and start the next", run: () => segment() },
    { key: "d", label: "discard the last segment", run: away(discard) },
    { key: "r", label: "rescan: discard and record again", run: away(rescan) },
    { key: "u", label: "undo discard: restore the last one", run: restore },
    { key: "a", label: "record while the probe touches (Auto)", run: toggleAuto },
  ]);
  return (
    <PageLayout
      title="Scan"
      stripHeight="48%"
      side={
        <>
          <GuidePanel />
<RecordPanel />
          <SourcePanel fields={fields} />
          <TuningPanel fields={fields} />
        </>
      }
      results={
        <>
          <HintsPanel />
          <SensorsPanel />
          <ResultPanel />
          <SegmentsPanel />
        </>
      }
      strip={
        <div class="scan-strip">
          <ProfilePlot />
          <div class="scan-live">
            <Panel title="Force / N" grow>
              <LivePlot label="Force in newton" buffer={force} series={FORCE} yAxis={{ label: "" }} window_s={kWindow_s} leastHeight={0.5} testId="scan-force-plot" />
            </Panel>
            <Panel title="Acceleration / m/s²" grow>
              <LivePlot label="Specific force of the accelerometer in the marker's frame, m/s²" buffer={acceleration} series={ACCELERATION}
                yAxis={{ label: "" }} window_s={kWindow_s} leastHeight={2} testId="scan-acceleration-plot" />
            </Panel>
          </div>
        </div>
      }
    >
      <div class="scan-main">
        <ScanView />
        <CameraImage />
      </div>
      <StreamLine />
    </PageLayout>
  );
}

/** The stream's values for tests and scripts. */
function StreamLine() {
  const { median_ms, late_ms, rows, lost, profile_ms, profile_late_ms } = figures.value;
  const told = (time_ms: number) => (Number.isFinite(time_ms) ? time_ms.toFixed(1) : "");
  return (
    <output
      class="visually-hidden"
      aria-live="off"
      data-testid="scan-stream"
      data-open={String(state.value?.open ?? false)}
      data-rows={rows}
      data-rows-lost={lost}
      data-latency-ms={told(median_ms)}
      data-latency-p95-ms={told(late_ms)}
      data-profile-ms={told(profile_ms)}
      data-profile-p95-ms={told(profile_late_ms)}
    />
  );
}
