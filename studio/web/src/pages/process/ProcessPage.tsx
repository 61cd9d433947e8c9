import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { AccuracyPlot } from "../../measured/AccuracyPlot";
import { ComplianceScatter } from "../../measured/ComplianceScatter";
import { ConfigTable } from "../../measured/ConfigTable";
import { DroppedTable } from "../../measured/DroppedTable";
import { FiguresTable } from "../../measured/FiguresTable";
import { measuredOf, type Measured } from "../../measured/measured";
import { ProfilePlot } from "../../measured/ProfilePlot";
import { RepeatabilityPlot } from "../../measured/RepeatabilityPlot";
import { SpectrumPlot } from "../../measured/SpectrumPlot";
import { TrajectoryView } from "../../measured/TrajectoryView";
import { Verdict } from "../../measured/Verdict";
import { WayPlot } from "../../measured/WayPlot";
import type { Block } from "../../net/block";
import { call, link } from "../../net/connection";
import { edit, section } from "../../state/document";
import type { ConfigField } from "../../ui/configFields";
import { useKeys } from "../../ui/keys";
import { PageLayout } from "../../ui/PageLayout";
import { Panel } from "../../ui/Panel";
import { Tabs } from "../../ui/Tabs";
import { complain } from "../../ui/toast";
import { MergeResults } from "./MergeResults";
import { MergeView } from "./MergeView";
import { mergeOf } from "./merging";
import { NewestWins } from "./newestWins";
import { currentIndex, withConfig, type ProcessSection } from "./processing";
import { ScansPanel } from "./ScansPanel";
import { StrokesPanel } from "./StrokesPanel";
import { TuningPanel } from "./TuningPanel";
import { WritePanel } from "./WritePanel";
import "./process.css";

const chosen = section<ProcessSection>("process");

const TABS = [
  { id: "profile", label: "Profile" },
  { id: "path", label: "Path" },
  { id: "spectrum", label: "Spectrum" },
  { id: "compliance", label: "Compliance" },
  { id: "accuracy", label: "Accuracy" },
  { id: "repeatability", label: "Repeatability" },
  { id: "merge", label: "Merge" },
  { id: "dropped", label: "Quality" },
  { id: "settings", label: "Settings" },
];
const kPatience_ms = 1500;

/** From recordings to profiles, live under every setting. */
export default function ProcessPage() {
  const state = chosen.value;
  const [tab, setTab] = useState("profile");
  const [defaults, setDefaults] = useState<ConfigField[]>([]);
  const [mergeDefaults, setMergeDefaults] = useState<ConfigField[]>([]);
  const [measured, fault] = useMeasured(state);
  const fields = useMemo(() => withConfig(defaults, state.config), [defaults, state.config]);
  const at = currentIndex(state);
  const merges = tab === "merge";

  useEffect(() => {
    if (link.value !== "open") return;
    call<{ fields: ConfigField[]; merge_fields: ConfigField[] }>("process.fields").then((answer) => {
      setDefaults(answer.fields);
      setMergeDefaults(answer.merge_fields);
    }, complain);
  }, [link.value]);

  const turn = (by: number) => setTab(TABS[(TABS.findIndex(({ id }) => id === tab) + by + TABS.length) % TABS.length]!.id);
  const look = (by: number) => {
    if (state.scans.length < 2) return;
    const next = (at + by + state.scans.length) % state.scans.length;
    return edit("/process/current", next, "show another recording");
  };
  useKeys([
    { key: "]", label: "next tab", run: () => turn(1) },
    { key: "[", label: "previous tab", run: () => turn(-1) },
    { key: ".", label: "next recording", run: () => look(1) },
    { key: ",", label: "previous recording", run: () => look(-1) },
  ]);

  return (
    <PageLayout
      title="Process"
      side={
        <>
          {merges ? <StrokesPanel section={state} fields={withConfig(mergeDefaults, mergeOf(state).config)} /> : <ScansPanel section={state} measured={measured} />}
          <TuningPanel fields={fields} />
        </>
      }
      results={
        merges ? (
          <MergeResults section={state} />
        ) : (
          <>
            <Panel title="Result" testId="result" grow>
              {measured ? <Verdict measured={measured} /> : <p class="empty">{fault || (at < 0 ? "No recording yet." : "Working …")}</p>}
              {measured && <FiguresTable figures={measured.figures} />}
            </Panel>
            <WritePanel section={state} />
          </>
        )
      }
    >
      <div class="process-main">
        <Tabs label="What is shown" tabs={TABS} chosen={tab} onChoose={setTab}>
          {merges ? <MergeView section={state} /> : tab === "repeatability" ? <Repeatability section={state} /> : measured ? <Shown tab={tab} measured={measured} /> : <Waiting fault={fault} chosen={at >= 0} />}
        </Tabs>
      </div>
    </PageLayout>
  );
}

/** What the server measures of the current recording with the document's settings, and why it could not. */
function useMeasured(state: ProcessSection): [Measured | null, string] {
  const [measured, setMeasured] = useState<Measured | null>(null);
  const [fault, setFault] = useState("");
  const queue = useRef(new NewestWins(kPatience_ms));
  const scan = state.scans[currentIndex(state)];
  useEffect(() => {
    if (!scan) {
      setMeasured(null);
      setFault("");
      return;
    }
    if (link.value !== "open") return;
    queue.current.ask(async (isNewest) => {
      try {
        const block = await call<Block>("process.run", { ...scan });
        if (!isNewest()) return;
        setMeasured(measuredOf(block));
        setFault("");
      } catch (error) {
        if (!isNewest() || (error as Error).message === "cancelled") return;
        setMeasured(null);
        setFault((error as Error).message);
        complain(error);
      }
    });
  }, [scan?.recording, scan?.segment, state.config, link.value]);
  return [measured, fault];
}

function Shown({ tab, measured }: { tab: string; measured: Measured }) {
  switch (tab) {
    case "path":
      return <TrajectoryView measured={measured} />;
    case "spectrum":
      return <SpectrumPlot measured={measured} />;
    case "compliance":
      return <ComplianceScatter measured={measured} />;
    case "accuracy":
      return <AccuracyPlot measured={measured} />;
    case "dropped":
      return <DroppedTable measured={measured} />;
    case "settings":
      return <ConfigTable measured={measured} />;
    default:
      return (
        <div class="process-plots">
          <ProfilePlot measured={measured} what="height" />
          <ProfilePlot measured={measured} what="texture" />
          <WayPlot measured={measured} what="force" />
          <WayPlot measured={measured} what="speed" />
        </div>
      );
  }
}

function Waiting({ fault, chosen }: { fault: string; chosen: boolean }) {
  if (fault) return <p class="empty" role="alert">No result: {fault}</p>;
  if (chosen) return <p class="empty">Working …</p>;
  return (
    <div class="page-empty">
      <h2>No recording is chosen</h2>
      <p>Add one at the left. This page shows its profile, path, spectrum and metrics, and updates them with every setting.</p>
      <p>The Scan page makes recordings, from a probe or from the virtual bench.</p>
    </div>
  );
}

/** The chosen recordings over one another, worked out while they are looked at. */
function Repeatability({ section: state }: { section: ProcessSection }) {
  const [block, setBlock] = useState<Block | null>(null);
  const [fault, setFault] = useState("");
  const queue = useRef(new NewestWins(kPatience_ms));
  useEffect(() => {
    if (state.scans.length < 2 || link.value !== "open") return setBlock(null);
    queue.current.ask(async (isNewest) => {
      try {
        const compared = await call<Block>("process.compare");
        if (!isNewest()) return;
        setBlock(compared);
        setFault("");
      } catch (error) {
        if (!isNewest() || (error as Error).message === "cancelled") return;
        setBlock(null);
        setFault((error as Error).message);
      }
    });
  }, [state.scans, state.config, link.value]);
  if (fault) return <p class="empty" role="alert">The recordings could not be compared: {fault}</p>;
  if (state.scans.length < 2) return <p class="empty">Add a second recording of the same surface to compare it with the first.</p>;
  return block ? <RepeatabilityPlot block={block} /> : <p class="empty">Working …</p>;
}
