import { useState } from "preact/hooks";
import { go } from "../../app/go";
import { VerdictList } from "../../measured/VerdictList";
import { verdictsOf, type VerdictEntry } from "../../measured/verdicts";
import { call } from "../../net/connection";
import { Button } from "../../ui/Button";
import { readEntries } from "../../ui/entries";
import { Panel } from "../../ui/Panel";
import { TextField } from "../../ui/TextField";
import { Toggle } from "../../ui/Toggle";
import { chooseScene } from "../feel/feelChoices";
import { align, missing, open } from "./alignState";
import { isScene } from "./FilesPanel";

interface Written {
  name: string;
  scene: string;
  trustworthy: boolean;
  verdict: string;
  verdicts?: VerdictEntry[];
  command: string;
}

/** Writes what `asperity register` writes. */
export function WritePanel() {
  const mesh = align.value?.mesh ?? "";
  const stem = (mesh.split("/").pop() ?? "").replace(/\.[^.]*$/, "");
  const [typed, setTyped] = useState("");
  const [replace, setReplace] = useState(false);
  const [written, setWritten] = useState<Written | null>(null);
  const name = typed || `${stem || "mesh"}-aligned`;
  const lacks = missing.value || (align.value?.T_mesh_world ? "" : "Move the path to the mesh first: by hand, by points or by a registration.");
  const scene = isScene(mesh);
  const [apart, setApart] = useState(false);
  const into = scene && !apart;
  const write = async () => {
    setWritten(null);
    setWritten(await call<Written>("align.write", into ? { into } : { name, replace }));
    setReplace(false);
    await readEntries();
    if (into) await open();
  };
  const feel = async () => {
    await chooseScene(written!.scene);
    go("feel");
  };
  return (
    <Panel title="Write" testId="align-write">
      {scene && <Toggle label="Into another folder" on={apart} onChange={setApart} hint="Without it the scans are added to the scene." testId="align-apart" />}
      {!into && <TextField label="Folder" value={name} onChange={setTyped} hint="In the project. The registration is completed from the current pose." />}
      {!into && <Toggle label="Replace an existing folder" on={replace} onChange={setReplace} />}
      <Button
        kind="primary"
        onClick={write}
        disabled={lacks !== ""}
        hint={lacks || undefined}
        testId="align-write-button"
      >
        {into ? "Add to the scene" : "Write result"}
      </Button>
      <div role="status" data-testid="align-written">
        {written && (
          <>
            <p>Written to {written.name}.</p>
            {verdictsOf(written).length > 0 && <VerdictList verdicts={verdictsOf(written)} />}
            <Button onClick={feel} testId="align-feel">
              Open in Feel
            </Button>
            <details>
              <summary>Command line for the same result</summary>
              <code class="align-command">{written.command}</code>
            </details>
          </>
        )}
      </div>
    </Panel>
  );
}
