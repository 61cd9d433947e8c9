import { useState } from "preact/hooks";
import type { Block } from "../../net/block";
import { call } from "../../net/connection";
import { Button } from "../../ui/Button";
import { FilePicker } from "../../ui/FilePicker";
import { FolderWriter } from "../../ui/FolderWriter";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import type { ProcessSection } from "./processing";

interface Written {
  folder: string;
  files: string[];
  notes: string[];
}

/** Writes what `asperity process` writes, of all recordings that are chosen, and hands out reports. */
export function WritePanel({ section }: { section: ProcessSection }) {
  const [report, setReport] = useState("");
  return (
    <Panel title="Write" testId="write">
      <FolderWriter
        folder="results"
        button="Write results"
        hint="trajectory.csv, profile.csv, texture.json, result.json and report.html of each recording"
        disabled={section.scans.length === 0}
        write={(name, replace) => call<Written>("process.write", { name, replace })}
        buttonTestId="write-results"
        testId="written"
      >
        {(written) => (
          <>
            <p>Written to {written.files.map((file) => `${written.folder}${file && "/"}${file}`).join(", ")}.</p>
            {written.notes.map((note) => (
              <p key={note}>{note}</p>
            ))}
            <Button onClick={() => saveReport(written.folder)} testId="save-report" hint="One page that opens without the studio and without a network connection">
              Save the report
            </Button>
          </>
        )}
      </FolderWriter>
      <FilePicker label="Report of a result" kinds={["result"]} value={report} none="Choose one to save it …" testId="report-of"
        onChange={(folder) => {
          setReport("");
          if (folder) void saveReport(folder).catch(complain);
        }} />
    </Panel>
  );
}

/** The browser keeps it as a file: opened from there it is outside of this page. */
async function saveReport(folder: string): Promise<void> {
  const block = await call<Block>("process.report", { folder });
  const address = URL.createObjectURL(new Blob([block.arrays.page! as Uint8Array<ArrayBuffer>], { type: "text/html" }));
  const link = document.createElement("a");
  link.href = address;
  link.download = `${folder.replaceAll("/", "_")}_report.html`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), kKept_ms);
}

const kKept_ms = 10_000;
