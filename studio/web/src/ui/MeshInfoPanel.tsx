import { useEffect, useState } from "preact/hooks";
import { call, link } from "../net/connection";
import { project } from "../state/project";
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

/** The table of a mesh, measured when it is shown. */
export function MeshInfoTable({ file, unit = "" }: MeshInfoProps) {
  const [info, setInfo] = useState<MeshInfo | null>(null);
  const [fault, setFault] = useState("");
  const projectUnit = project.value.mesh_unit;
  useEffect(() => {
    if (link.value !== "open") return;
    let newest = true;
    setFault("");
    call<MeshInfo>("mesh.info", { file, unit })
      .then((found) => newest && setInfo(found))
      .catch((error: unknown) => {
        if (!newest) return;
        setInfo(null);
        setFault(error instanceof Error ? error.message : String(error));
      });
    return () => void (newest = false);
  }, [file, unit, projectUnit, link.value]);
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

/** The same in a panel of a page, folded at first. */
export function MeshInfoPanel({ file, unit }: MeshInfoProps) {
  if (!file) return null;
  return (
    <Panel title="Mesh information" collapsible open={false} testId="mesh-info-panel">
      <MeshInfoTable file={file} unit={unit} />
    </Panel>
  );
}
