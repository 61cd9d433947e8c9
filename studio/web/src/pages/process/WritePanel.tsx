import { useState } from "preact/hooks";
import { call } from "../../net/connection";
import { Button } from "../../ui/Button";
import { Panel } from "../../ui/Panel";
import { TextField } from "../../ui/TextField";
import { say } from "../../ui/toast";
import { Toggle } from "../../ui/Toggle";
import type { ProcessSection } from "./processing";

interface Written {
  folder: string;
  files: string[];
  notes: string[];
}

/** Writes what `asperity process` writes, of all recordings that are chosen. */
export function WritePanel({ section }: { section: ProcessSection }) {
  const [name, setName] = useState("results");
  const [replace, setReplace] = useState(false);
  const [written, setWritten] = useState<Written | null>(null);
  const write = async () => {
    const done = await call<Written>("process.write", { name, replace });
    setReplace(false);
    setWritten(done);
    say(`The results are in ${done.folder}.`);
  };
  return (
    <Panel title="Write" testId="write">
      <TextField label="Folder" value={name} onInput={setName} onChange={setName} />
      <Toggle label="Replace what has this name" on={replace} onChange={setReplace} />
      <Button onClick={write} disabled={section.scans.length === 0 || name === ""} testId="write-results">
        Write results
      </Button>
      <div role="status" class="process-written" data-testid="written">
        {written && (
          <>
            <p>
              trajectory.csv, profile.csv, texture.json, result.json and report.html in {written.files.map((file) => `${written.folder}${file && "/"}${file}`).join(", ")}.
            </p>
            {written.notes.map((note) => (
              <p key={note}>{note}</p>
            ))}
          </>
        )}
      </div>
    </Panel>
  );
}
