import "./align.css";
import { useEffect } from "preact/hooks";
import { PageLayout } from "../../ui/PageLayout";
import { AlignView } from "./AlignView";
import { followAlign } from "./alignState";
import { FilesPanel } from "./FilesPanel";
import { HandPanel } from "./HandPanel";
import { IterationStrip } from "./IterationStrip";
import { PicksPanel } from "./PicksPanel";
import { ResidualPanel } from "./ResidualPanel";
import { RunPanel } from "./RunPanel";
import { ScansPanel } from "./ScansPanel";
import { SettingsPanel } from "./SettingsPanel";
import { WritePanel } from "./WritePanel";

/** A scan path is laid on a mesh: by hand, by picked points, by registration. */
export default function AlignPage() {
  useEffect(followAlign, []);
  return (
    <PageLayout
      title="Align"
      side={
        <>
          <FilesPanel />
          <HandPanel />
          <PicksPanel />
        </>
      }
      results={
        <>
          <RunPanel />
          <ScansPanel />
          <ResidualPanel />
          <WritePanel />
          <SettingsPanel />
        </>
      }
      strip={<IterationStrip />}
      stripHeight="230px"
    >
      <AlignView />
    </PageLayout>
  );
}
