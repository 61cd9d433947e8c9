// What the operator tells the recorder.
import { signal } from "@preact/signals";
import { call } from "../../net/connection";
import { edit, valueAt } from "../../state/document";
import { go } from "../../app/routes";
import { say } from "../../ui/toast";
import { type ProcessSection, withScan } from "../process/processing";
import { abilities, dearSegment } from "./scanState";
import { processSettings, scan } from "./settings";
import { refined, state } from "./stream";

const can = () => abilities(state.value);

export async function open(): Promise<void> {
  const { recording } = await call<{ recording: string }>("scan.open");
  say(`The source is open; the recording will be ${recording}.`);
}

export async function close(): Promise<void> {
  const { recording } = await call<{ recording: string | null }>("scan.close");
  say(recording ? `${recording} is finished.` : "Nothing was scanned: no recording was kept.");
}

export const start = () => can().start && call("scan.start");
export const stop = () => can().stop && call("scan.stop");
export const startOrStop = () => (can().stop ? stop() : start());
export const segment = (name = "") => can().segment && call("scan.segment", { name });

/** What is asked before a segment is thrown away; null: nothing. */
export const asked = signal<"discard" | "rescan" | null>(null);

/** Throws the last segment away; for good, so what took longer than a second is asked about. */
export const discard = () => can().discard && throwAway("discard");
export const rescan = () => can().rescan && throwAway("rescan");

function throwAway(how: "discard" | "rescan") {
  if (!dearSegment(state.value)) return call(`scan.${how}`);
  asked.value = how;
}

export function answer(yes: boolean) {
  const how = asked.value;
  asked.value = null;
  return yes && how ? call(`scan.${how}`) : undefined;
}

export const toggleAuto = () => edit("/scan/auto", !scan.value.auto, scan.value.auto ? "record by hand" : "record while in contact");

/** Shows the last scan on the Process page, with the settings that it was refined by. */
export async function openInProcess(): Promise<void> {
  const head = refined.value?.head;
  if (!head || head.failure) return;
  if (state.value?.open) await close();
  const there = valueAt("/process") as ProcessSection;
  const next = withScan(there, { recording: head.recording, segment: head.segment });
  await edit("/process", { ...next, config: { ...there.config, ...processSettings(scan.value.settings) } }, `open ${head.recording}`);
  go("process");
}
