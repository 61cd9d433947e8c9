import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { ConfigForm } from "../../ui/ConfigForm";
import type { ConfigField } from "../../ui/configFields";
import { entries } from "../../ui/entries";
import { cancelJob, jobs } from "../../ui/job";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import { kMergeJob, merge, merging } from "./mergeState";
import { mergeOf, strokeChoices, withStroke } from "./merging";
import type { ProcessSection } from "./processing";

/** Which strokes are merged, and by which settings. */
export function StrokesPanel({ section, fields }: { section: ProcessSection; fields: readonly ConfigField[] }) {
  const { strokes } = mergeOf(section);
  const choices = strokeChoices(entries.value, strokes);
  const job = jobs.value.find(({ title }) => title === kMergeJob);
  const lacks = strokes.length < 2 ? "Choose two strokes or more." : "";
  const choose = (name: string, on: boolean) =>
    edit("/process", withStroke(section, name, on), on ? `merge ${name}` : `leave out ${name}`).catch(complain);
  const set = (path: string, text: string | null) =>
    edit(`/process/merge/config/${path}`, text, text === null ? `reset ${path}` : `set ${path}`).catch(complain);
  return (
    <Panel title="Strokes over one line" testId="merge-strokes">
      {choices.length === 0 && <p class="empty">The folder contains no recording and no result.</p>}
      <ul class="process-strokes" aria-label="Merged strokes">
        {choices.map(({ name, kind }) => (
          <li key={name}>
            <label>
              <input type="checkbox" checked={strokes.includes(name)} onChange={(event) => void choose(name, event.currentTarget.checked)} />
              <span>{name}</span>
              <span class="process-kind">{kind}</span>
            </label>
          </li>
        ))}
      </ul>
      <p class="field-hint">Recordings are processed with the settings below, without removal of noise. Results must be written with profile.remove_noise off.</p>
      <div class="buttons">
        <Button kind="primary" onClick={() => merge(section)} disabled={lacks !== "" || merging.value} hint={lacks || "Aligns the strokes and averages them, weighted by their noise"} testId="merge-run">
          Merge
        </Button>
        {merging.value && job && (
          <Button onClick={() => cancelJob(job.id)} testId="merge-cancel">
            Cancel
          </Button>
        )}
      </div>
      <details>
        <summary>Settings of the alignment</summary>
        <ConfigForm fields={fields} onChange={set} />
      </details>
    </Panel>
  );
}
