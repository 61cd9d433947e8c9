import { useEffect, useState } from "preact/hooks";
import { link, Refusal } from "../net/connection";
import { project } from "../state/project";
import { askShared, isCancelled } from "./askShared";
import { entries } from "./entries";
import { Figure } from "./Figure";
import { Figures } from "./Figures";
import { infoRows, type MeshInfo } from "./meshInfo";
import { Panel } from "./Panel";
import { Warning } from "./Warning";

export interface MeshInfoProps {
  file: string;
  /** That a page has chosen for the file; "": none. */
  unit?: string;
}

/** What was measured, or why it could not be; `of`: the file and the units. */
interface Found {
  of: string;
  info?: MeshInfo;
  fault?: string;
}

/** The table of a mesh, measured when it is shown. */
export function MeshInfoTable({ file, unit = "" }: MeshInfoProps) {
  const [found, setFound] = useState<Found | null>(null);
  const projectUnit = project.value.mesh_unit;
  const of = JSON.stringify([file, unit, projectUnit]);
  useEffect(() => {
    if (link.value !== "open") return;
    let newest = true;
    askShared<MeshInfo>("mesh.info", { file, unit }, { wanted: () => newest })
      .then((info) => newest && setFound({ of, info }))
      .catch((error: unknown) => {
        if (!newest) return;
        const isKnown = (old: Found | null) => isCancelled(error) && old?.of === of && old.info !== undefined;
        setFound((old) => (isKnown(old) ? old : { of, fault: faultWords(error) }));
      });
    return () => void (newest = false);
    // A file may be replaced under its name: the list of files is then read again.
  }, [of, entries.value, link.value]);
  const { info, fault } = found?.of === of ? found : {};
  if (fault) return <Warning words={fault} />;
  if (!info) return <p class="field-hint">Measuring {file} …</p>;
  return (
    <div data-testid="mesh-info">
      {!info.likely && <Warning words="This size is unlikely for a scanned object. Check the unit." />}
      <Figures>
        {infoRows(info, projectUnit).map((row) => (
          <Figure key={row.label} {...row} />
        ))}
      </Figures>
      {info.problems.map((problem) => (
        <Warning key={problem} words={problem} />
      ))}
    </div>
  );
}

function faultWords(error: unknown): string {
  if (isCancelled(error)) return "The mesh was not measured, because other windows measure meshes too. Close this panel and open it again.";
  if (error instanceof Refusal && error.hint) return `${error.message}. ${error.hint}`;
  return error instanceof Error ? error.message : String(error);
}

/** The same in a panel of a page, folded at first. */
export function MeshInfoPanel({ file, unit }: MeshInfoProps) {
  if (!file) return null;
  return (
    <Panel title="Mesh information" collapsible open={false} testId="mesh-info-panel">
      <MeshInfoTable file={file} unit={unit} />
    </Panel>
  );
}
