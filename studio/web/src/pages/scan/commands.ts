// The operator's commands to the recorder.
import { call } from "../../net/connection";
import { edit, valueAt } from "../../state/document";
import { go } from "../../app/go";
import { say } from "../../ui/toast";
import { type ProcessSection, withScan } from "../process/processing";
import { abilities } from "./scanState";
import { processSettings, scan } from "./settings";
import { refined, state } from "./stream";

const can = () => abilities(state.value);

export async function open(): Promise<void> {
  const { recording } = await call<{ recording: string }>("scan.open");
  say(`The source is open; the recording will be ${recording}.`);
}

export async function close(): Promise<void> {
  const { recording } = await call<{ recording: string | null }>("scan.close");
  say(recording ? `${recording} is finished.` : "Nothing was scanned, so no recording was kept.");
}

export const start = () => can().start && call("scan.start");
export const stop = () => can().stop && call("scan.stop");
export const startOrStop = () => (can().stop ? stop() : start());
export const segment = (name = "") => can().segment && call("scan.segment", { name });

/** Discards the last segment; it can be restored until the recording is closed. */
export const discard = () => can().discard && call("scan.discard");
export const rescan = () => can().rescan && call("scan.rescan");
export const restore = () => can().restore && call("scan.restore");

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
