import "./align.css";
import { useEffect, useState } from "preact/hooks";
import { PageLayout } from "../../ui/PageLayout";
import { Tabs } from "../../ui/Tabs";
import { AlignView } from "./AlignView";
import { MeshInfoPanel } from "../../ui/MeshInfoPanel";
import { align, followAlign } from "./alignState";
import { AreaPanel } from "./AreaPanel";
import { AreaResults } from "./AreaResults";
import { AreaView } from "./AreaView";
import { FilesPanel } from "./FilesPanel";
import { HandPanel } from "./HandPanel";
import { IterationStrip } from "./IterationStrip";
import { PicksPanel } from "./PicksPanel";
import { ResidualPanel } from "./ResidualPanel";
import { RunPanel } from "./RunPanel";
import { ScansPanel } from "./ScansPanel";
import { SettingsPanel } from "./SettingsPanel";
import { WritePanel } from "./WritePanel";

const kTabs = [
  { id: "path", label: "Scans on the mesh" },
  { id: "area", label: "Area" },
];

/** A scan path is laid on a mesh: by hand, by picked points, by registration; many become an area. */
export default function AlignPage() {
  const [tab, setTab] = useState("path");
  useEffect(followAlign, []);
  const isArea = tab === "area";
  return (
    <PageLayout
      title="Align"
      side={
        isArea ? (
          <AreaPanel />
        ) : (
          <>
            <FilesPanel />
            <MeshInfoPanel file={align.value?.mesh ?? ""} unit={align.value?.mesh_unit ?? ""} />
            <HandPanel />
            <PicksPanel />
          </>
        )
      }
      results={
        isArea ? (
          <AreaResults />
        ) : (
          <>
            <RunPanel />
            <ScansPanel />
            <ResidualPanel />
            <WritePanel />
            <SettingsPanel />
          </>
        )
      }
      strip={isArea ? undefined : <IterationStrip />}
      stripHeight="230px"
    >
      <Tabs label="What is shown" tabs={kTabs} chosen={tab} onChoose={setTab}>
        {isArea ? <AreaView /> : <AlignView />}
      </Tabs>
    </PageLayout>
  );
}
