import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { delay, fixed } from "../../ui/format";
import { Lamp } from "../../ui/Lamp";
import { Panel } from "../../ui/Panel";
import { bodyWords, contactWords, gravityWords, objectHint, lostRows, sensorWords, type Words } from "./scanState";
import { figures, state } from "./stream";

/** The states of probe and tracker, rates, losses, contact, gravity, delay. */
export function SensorsPanel() {
  const now = state.value?.open ? state.value : null;
  const recorder = now?.recorder;
  const waits = (now?.source?.plays ?? false) && !now?.source?.playing;
  const stream = figures.value;
  return (
    <Panel title="Sensors" testId="scan-sensors">
      <dl class="scan-lamps">
        <LampRow label="Contact" words={contactWords(recorder)} testId="scan-contact" live />
        <LampRow label="Probe" words={sensorWords(recorder?.probe, waits)} testId="scan-probe-state" />
        <LampRow label="Tracker" words={sensorWords(recorder?.poses, waits)} testId="scan-tracker-state" />
        {recorder?.bodies?.map((body) => (
          <LampRow key={body.name} label={body.name === "object" ? "Object" : body.name} words={bodyWords(body)} testId={`scan-body-${body.name}`} live />
        ))}
        <LampRow label="Calibration" words={now ? (now.source?.calibrated ? { lamp: "good", word: "known" } : { lamp: "warn", word: "none" }) : { lamp: "off", word: "–" }} testId="scan-calibration" />
        <LampRow label="Gravity" words={gravityWords(recorder)} testId="scan-gravity" />
      </dl>
      {[recorder?.probe, recorder?.poses].map((sensor) => sensor?.message && sensor.state !== "running" && <p class="field-hint" role="status">{sensor.message}</p>)}
      {[...(recorder?.probe.warnings ?? []), ...(recorder?.poses.warnings ?? [])].map((warning) => (
        <p key={warning} class="field-hint">
          {warning}
        </p>
      ))}
      {objectHint(recorder) && <p class="field-hint">{objectHint(recorder)}</p>}
      {(now?.live?.poses_late ?? 0) > 0 && (
        <p class="field-hint" role="status">
          {now!.live!.poses_late} poses arrived too late for the live profile, because this machine is too busy. The recording and the refined profile contain them.
        </p>
      )}
      <Figures>
        <Figure label="Force" value={fixed(recorder?.force_N, recorder?.force_is_calibrated ? 2 : 0) + (recorder?.force_is_calibrated ? "\u202fN" : recorder ? " counts" : "")} testId="scan-force" />
        <Figure label="Probe" value={recorder ? `${Math.round(recorder.probe.rate_Hz)} rows/s` : null} testId="scan-probe-rate" />
        <Figure label="Tracker" value={recorder ? `${Math.round(recorder.poses.rate_Hz)} poses/s` : null} testId="scan-pose-rate" />
        <Figure label="Rows lost" value={recorder ? String(lostRows(recorder)) : "–"} hint="Between the probe and the recording." testId="scan-lost" />
        <Figure label="Written" value={recorder ? recorder.disk_bytes * 1e-6 : null} unit="MB" digits={3} />
        <Figure label="Display latency" value={delay(stream.median_ms)} hint="From the sensor to the drawn frame, median." testId="scan-latency" />
        <Figure label="Profile" value={Number.isFinite(stream.profile_ms) ? `${delay(stream.profile_ms)} behind` : null} hint="From the tip's motion to the newest point of the profile on the screen, median." testId="scan-profile-latency" />
      </Figures>
    </Panel>
  );
}

function LampRow({ label, words, testId, live }: { label: string; words: Words; testId: string; live?: boolean }) {
  return (
    <div>
      <dt>{label}</dt>
      <dd>
        <Lamp state={words.lamp} word={words.word} live={live} testId={testId} />
      </dd>
    </div>
  );
}
