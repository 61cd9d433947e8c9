import type { Measured } from "../../measured/measured";
import { edit } from "../../state/document";
import { FilePicker } from "../../ui/FilePicker";
import { IconButton } from "../../ui/IconButton";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { complain } from "../../ui/toast";
import { currentIndex, scanTitle, withoutScan, withScan, type ProcessSection } from "./processing";

/** The recordings that are looked at; one of them is shown, all are compared. */
export function ScansPanel({ section, measured }: { section: ProcessSection; measured: Measured | null }) {
  const at = currentIndex(section);
  const current = section.scans[at];
  const change = (next: ProcessSection, label: string) => edit("/process", next, label).catch(complain);
  return (
    <Panel title="Recordings" testId="scans">
      <FilePicker
        label="Add a recording"
        kinds={["recording"]}
        value=""
        none="Choose one to add …"
        testId="add-recording"
        onChange={(recording) => recording && change(withScan(section, { recording, segment: "" }), `show ${recording}`)}
      />
      {section.scans.length === 0 && <p class="empty">Choose a recording of the folder to see its result.</p>}
      <ul class="process-scans" role="radiogroup" aria-label="Displayed recording">
        {section.scans.map((scan, index) => (
          <li key={scanTitle(scan)} role="presentation">
            <label>
              <input type="radio" name="process-current" checked={index === at} onChange={() => change({ ...section, current: index }, `show ${scanTitle(scan)}`)} />
              <span>{scanTitle(scan)}</span>
            </label>
            <IconButton icon="close" label={`Remove ${scanTitle(scan)}`} onClick={() => change(withoutScan(section, index), `remove ${scanTitle(scan)}`)} />
          </li>
        ))}
      </ul>
      {current && measured && measured.segments.length > 1 && (
        <Select
          label="Segment"
          value={current.segment || measured.segment}
          options={measured.segments}
          hint="Separate segments are processed one by one."
          testId="segment"
          onChange={(segment) => change({ ...section, scans: section.scans.map((scan, index) => (index === at ? { ...scan, segment } : scan)) }, `show ${segment}`)}
        />
      )}
    </Panel>
  );
}
