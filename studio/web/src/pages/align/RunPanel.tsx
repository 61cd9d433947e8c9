import { VerdictList } from "../../measured/VerdictList";
import { Button } from "../../ui/Button";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { cancelJob } from "../../ui/job";
import { Panel } from "../../ui/Panel";
import { Toggle } from "../../ui/Toggle";
import { Warning } from "../../ui/Warning";
import { verdictWords } from "./verdict";
import { ghost, isMoved, isRegistered, judged, missing, register, result, running, runningJob, showing, take, type RunResult, type Showing } from "./alignState";

/** The registration: from here or from anywhere, its verdict, and its runner-up. */
export function RunPanel() {
  const found = result.value;
  const job = runningJob.value;
  const waits = job?.title.startsWith("Registering again") ? "Repeating the earlier registration …" : "Registering …";
  return (
    <Panel title="Registration" testId="align-run">
      <div class="buttons">
        <Button
          kind="primary"
          onClick={() => register(true)}
          disabled={missing.value !== "" || running.value}
          hint={missing.value || "ICP from the current position of the path"}
          testId="align-run-here"
        >
          Refine current pose
        </Button>
        <Button
          onClick={() => register(false)}
          disabled={missing.value !== "" || running.value}
          hint={missing.value || "Searches the whole mesh, without a guess"}
          testId="align-run-anywhere"
        >
          Global search
        </Button>
        {running.value && job && <Button onClick={() => cancelJob(job.id)}>Cancel</Button>}
      </div>
      <div aria-live="polite">
        {found ? <Verdict found={found} /> : <p class="field-hint">{running.value ? waits : missing.value || "Not run yet."}</p>}
      </div>
      {isMoved.value && <MovedVerdict />}
      {isRegistered.value && <p class="field-hint">The path is at a registered pose.</p>}
    </Panel>
  );
}

/** The verdict on the pose that the path was moved to: the registration's own is about another. */
function MovedVerdict() {
  const now = judged.value;
  if (!now) return <p class="field-hint">The path was moved away from the registered pose. The new pose is being checked …</p>;
  return (
    <div class={now.trustworthy ? "align-verdict align-good" : "align-verdict align-doubt"} data-testid="align-moved-verdict">
      <strong>{now.trustworthy ? "Path as placed: valid. " : "Path as placed: invalid. "}</strong>
      {now.verdict}
      {now.verdicts.length > 0 && <VerdictList verdicts={now.verdicts} />}
    </div>
  );
}

function Verdict({ found }: { found: RunResult }) {
  const other = found.runner_up;
  return (
    <>
      <div class={found.trustworthy ? "align-verdict align-good" : "align-verdict align-doubt"} data-testid="align-verdict">
        <strong>
          {isMoved.value ? "Registered pose: " : ""}
          {found.trustworthy ? (isMoved.value ? "valid. " : "Valid. ") : isMoved.value ? "invalid. " : "Invalid. "}
        </strong>
        {verdictWords(found)}
        <details open={!found.trustworthy}>
          <summary>Full verdict</summary>
          {found.verdict}
          {(found.verdicts?.length ?? 0) > 0 && <VerdictList verdicts={found.verdicts!} />}
        </details>
      </div>
      <p class="field-hint">{found.certainty}</p>
      {found.undetermined.length > 0 && (
        <details>
          <summary>{found.undetermined.length === 1 ? "One motion" : `${found.undetermined.length} motions`} the scan does not determine</summary>
          <ul class="align-undetermined">
            {found.undetermined.map(({ description }) => (
              <li key={description}>The path {description}.</li>
            ))}
          </ul>
        </details>
      )}
      {found.problems.map((problem) => (
        <Warning key={problem} words={problem} />
      ))}
      <Figures>
        <Figure label="Residual, RMS" value={found.rms_m} factor={1e3} unit="mm" digits={3} testId="align-rms" />
        <Figure label="Outliers" value={`${found.outliers} of ${found.points}`} />
        {other && <Figure label="Runner-up, RMS" value={other.rms_m} factor={1e3} unit="mm" digits={3} />}
        {other && <Figure label="Distance of the runner-up" value={other.distance_m} factor={1e3} unit="mm" digits={3} />}
      </Figures>
      <fieldset class="align-show">
        <legend>Show</legend>
        <Choice value="placed" words="the current pose" />
        <Choice value="best" words="the registered pose" />
        {other && <Choice value="runner_up" words="the runner-up" />}
      </fieldset>
      {other && <Toggle label="Show the other pose too" on={ghost.value} onChange={(on) => (ghost.value = on)} />}
      <div class="buttons">
        <Button onClick={() => take("best")} disabled={missing.value !== ""} hint={missing.value || undefined} testId="align-take">
          Accept the pose
        </Button>
        {other && (
          <Button onClick={() => take("runner_up")} disabled={missing.value !== ""} hint={missing.value || undefined} testId="align-take-other">
            Accept the runner-up
          </Button>
        )}
      </div>
    </>
  );
}

function Choice({ value, words }: { value: Showing; words: string }) {
  return (
    <label>
      <input type="radio" name="align-show" checked={showing.value === value} onChange={() => (showing.value = value)} />
      {words}
    </label>
  );
}
