import { Lamp } from "../../ui/Lamp";
import { Panel } from "../../ui/Panel";
import { state } from "./stream";

const TITLES: Record<string, string> = {
  no_calibration: "No calibration",
  probe_silent: "Probe silent",
  rows_lost: "Rows lost",
  marker_lost: "Marker lost",
  accelerometer_saturating: "Accelerometer saturating",
  force_saturating: "Force sensor saturating",
  too_fast: "Too fast",
  too_light: "Force too small",
  too_hard: "Force too large",
  tilted_too_far: "Tilted too far",
  tilting_too_fast: "Rotating too fast",
  doubling_back: "Reversing direction",
};

/** What the operator should do differently, now. */
export function HintsPanel() {
  const now = state.value;
  const hints = now?.open ? (now.hints ?? []) : [];
  const waiting = now?.open && now.source?.playing ? now.live?.waiting : "";
  return (
    <Panel title="Hints" testId="scan-hints">
      <p class="visually-hidden" role="status" data-testid="scan-hints-said">
        {hints.map((hint) => TITLES[hint.kind] ?? hint.kind).join(". ")}
      </p>
      <ul class="scan-hints">
        {hints.map((hint) => (
          <li key={hint.kind} data-hint={hint.kind}>
            <Lamp state={hint.severity === "error" ? "bad" : "warn"} word={TITLES[hint.kind] ?? hint.kind} />
            <p>{hint.text}</p>
          </li>
        ))}
        {hints.length === 0 && <li class="empty">{waiting || (now?.open ? "No hints." : "Hints appear while you scan.")}</li>}
      </ul>
    </Panel>
  );
}
