// What the server states of a scan (topic "scan.state"), and the words and lamps for it.
import { fixed } from "../../ui/format";
import type { LampState } from "../../ui/Lamp";

export type SensorState = "absent" | "running" | "silent" | "lost" | "ended";

export interface Sensor {
  state: SensorState;
  name: string;
  message: string;
  warnings: string[];
  rate_Hz: number;
  received: number;
  lost: number;
  returned: number;
  queue_fill: number;
  overflowed: number;
}

export interface SegmentInfo {
  name: string;
  duration_s: number;
  open: boolean;
}

/** A marker body in addition to the probe's, such as the one on the object. */
export interface BodyState {
  name: string;
  rows: number;
  markers: number | null;
  pose_age_s: number | null;
}

export interface RecorderState {
  running_s: number;
  probe: Sensor;
  poses: Sensor;
  link: { samples: number; lost_samples: number; damaged_frames: number; estimated: boolean };
  tracking: { frames: number; poses: number; skipped_frames: number };
  force_N: number | null;
  force_is_calibrated: boolean;
  touching: boolean;
  contact_ready: boolean;
  touches: number;
  markers: number | null;
  pose: number[] | null;
  pose_age_s: number | null;
  bodies?: BodyState[];
  storing: boolean;
  automatic: boolean;
  segment: string;
  segments: SegmentInfo[];
  discarded: number;
  /** What would be brought back. */
  last_discarded: { name: string; duration_s: number } | null;
  recorded_s: number;
  probe_rows: number;
  tracker_rows: number;
  disk_bytes: number;
  gravity: { measured: boolean; implausible: boolean; magnitude_mps2: number | null };
  columns_missing: boolean;
  failure: string;
}

export interface SourceState {
  name: string;
  object: string;
  plays: boolean;
  playing: boolean;
  calibrated: boolean;
  tip_in_marker_m: [number, number, number];
  camera?: { width: number; height: number; fx: number; fy: number; cx: number; cy: number };
}

export interface Hint {
  kind: string;
  severity: "warning" | "error";
  text: string;
}

export interface ScanState {
  open: boolean;
  opening?: boolean;
  source?: SourceState;
  recorder?: RecorderState;
  live?: { waiting: string; age_s: number; poses_late: number; highest_speed_mps: number | null };
  hints?: Hint[];
}

export interface Words {
  lamp: LampState;
  word: string;
}

/** The one thing that the operator has to see from afar. */
export function recordWords(state: ScanState | null): Words {
  if (!state) return { lamp: "off", word: "…" };
  if (state.opening) return { lamp: "busy", word: state.open ? "Closing …" : "Opening …" };
  const recorder = state.recorder;
  if (!state.open || !recorder) return { lamp: "off", word: "No source open" };
  if (recorder.failure) return { lamp: "bad", word: "Disk failed" };
  if (recorder.storing) return { lamp: "good", word: "Recording" };
  if (recorder.automatic) return { lamp: "busy", word: "Waiting for contact" };
  return { lamp: "off", word: "Ready" };
}

export function contactWords(recorder: RecorderState | undefined): Words {
  if (!recorder) return { lamp: "off", word: "–" };
  if (!recorder.contact_ready) return { lamp: "busy", word: "measuring the idle level" };
  return recorder.touching ? { lamp: "good", word: "in contact" } : { lamp: "off", word: "in the air" };
}

const SENSOR_WORDS: Record<SensorState, Words> = {
  absent: { lamp: "off", word: "not used" },
  running: { lamp: "good", word: "running" },
  silent: { lamp: "warn", word: "no data yet" },
  lost: { lamp: "bad", word: "lost; reconnecting" },
  ended: { lamp: "warn", word: "ended" },
};

/** `waits`: the source is one that plays, and does not now. */
export function sensorWords(sensor: Sensor | undefined, waits: boolean): Words {
  if (!sensor) return { lamp: "off", word: "–" };
  if (waits && (sensor.state === "running" || sensor.state === "silent")) return { lamp: "off", word: "waiting for Start" };
  return SENSOR_WORDS[sensor.state];
}

/** Whether a further body is in view. A pose older than half a second counts as none. */
export function bodyWords(body: BodyState): Words {
  if (body.pose_age_s === null) return { lamp: "warn", word: "not seen yet" };
  if (body.pose_age_s > 0.5) return { lamp: "bad", word: "not in view" };
  const count = body.markers ?? 0;
  return { lamp: "good", word: count > 0 ? `${count} ${count === 1 ? "marker" : "markers"} in view` : "in view" };
}

/** What a person should know where the object moves. */
export const objectHint = (recorder: RecorderState | undefined): string =>
  recorder?.bodies?.some((body) => body.name === "object") ? "Path and profile on this page are in the tracker's world frame and are valid while the object is stationary. The Process page shows the scan relative to the object." : "";

export function gravityWords(recorder: RecorderState | undefined): Words {
  if (!recorder) return { lamp: "off", word: "–" };
  if (recorder.gravity.implausible) return { lamp: "warn", word: "measured, but implausible" };
  if (recorder.gravity.measured) return { lamp: "good", word: "measured" };
  return { lamp: "warn", word: "assumed: keep the probe still" };
}

/** Rows that are missing in the recording, for any reason. */
export const lostRows = (recorder: RecorderState): number =>
  recorder.link.lost_samples + recorder.probe.overflowed + recorder.poses.overflowed;

export interface Abilities {
  start: boolean;
  stop: boolean;
  segment: boolean;
  discard: boolean;
  rescan: boolean;
  restore: boolean;
}

/** What was discarded, and until when it can be brought back; "" if nothing was. */
export function discardedWords(state: ScanState | null): string {
  const recorder = state?.open ? state.recorder : undefined;
  const last = recorder?.last_discarded;
  if (!recorder || !last) return "";
  const others = recorder.discarded > 1 ? ` and ${recorder.discarded - 1} more` : "";
  return `${last.name} (${fixed(last.duration_s, 1)}\u202fs)${others} discarded; “Undo discard” (U) restores it until the recording is closed.`;
}

/** True for a live profile that agrees with the refined one. */
export const isLiveUsable = (difference: { correlation: number | null } | null | undefined): boolean => (difference?.correlation ?? 0) >= 0.5;

/** Which commands make sense now. In Auto a source that plays is still started by hand. */
export function abilities(state: ScanState | null): Abilities {
  const recorder = state?.open && !state.opening ? state.recorder : undefined;
  if (!recorder) return { start: false, stop: false, segment: false, discard: false, rescan: false, restore: false };
  const plays = state!.source?.plays ?? false;
  const playing = plays && (state!.source?.playing ?? false);
  const some = recorder.segments.length > 0;
  return {
    start: recorder.automatic ? plays && !playing : !recorder.storing,
    stop: recorder.automatic ? playing : recorder.storing,
    segment: !recorder.automatic && recorder.storing && !plays,
    discard: some,
    rescan: some && !(recorder.automatic && !plays),
    restore: recorder.last_discarded != null,
  };
}
