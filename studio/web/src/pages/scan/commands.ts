// What the operator tells the recorder.
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { go } from "../../app/routes";
import { say } from "../../ui/toast";
import { abilities } from "./scanState";
import { scan } from "./settings";
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
export const discard = () => can().discard && call("scan.discard");
export const rescan = () => can().rescan && call("scan.rescan");
export const toggleAuto = () => edit("/scan/auto", !scan.value.auto, scan.value.auto ? "record by hand" : "record while in contact");

/** Shows the last scan's recording on the Process page. */
export async function openInProcess(): Promise<void> {
  const name = refined.value?.head.recording as string | undefined;
  if (!name) return;
  if (state.value?.open) await close();
  await edit("/process/recordings", [name], `open ${name}`);
  go("process");
}
