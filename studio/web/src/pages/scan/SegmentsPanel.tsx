import { fixed } from "../../ui/format";
import { Panel } from "../../ui/Panel";
import { state } from "./stream";

/** What has been recorded so far. */
export function SegmentsPanel() {
  const recorder = state.value?.open ? state.value.recorder : undefined;
  const segments = recorder?.segments ?? [];
  return (
    <Panel title={state.value?.open ? `Segments in ${state.value.source?.name}` : "Segments"} testId="scan-segments">
      {segments.length === 0 ? (
        <p class="empty">None yet.</p>
      ) : (
        <ol class="scan-segments">
          {segments.map((segment, index) => (
            <li key={`${index} ${segment.name}`}>
              <span>{segment.name}</span>
              <span>{segment.open ? "recording" : `${fixed(segment.duration_s, 1)}\u202fs`}</span>
            </li>
          ))}
        </ol>
      )}
    </Panel>
  );
}
