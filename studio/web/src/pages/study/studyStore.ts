// The state of the session, the same in every window; and what is asked of the server.
import { effect, signal, type ReadonlySignal } from "@preact/signals";
import { call, link, onEvent } from "../../net/connection";
import { edit, section } from "../../state/document";
import { leaseIsMine, takeForce } from "../../state/lease";
import { feelStatus } from "../feel/feelStore";
import type { Session, Study, StudySection, StudyStatus } from "./study";

export const studySection = section<StudySection>("study");

const newest = signal<StudyStatus | null>(null);
export const studyStatus: ReadonlySignal<StudyStatus | null> = newest;

let follows = false;

/** Begins to listen; more calls do nothing. */
export function followStudy(): void {
  if (follows) return;
  follows = true;
  onEvent("study", (status: StudyStatus) => void (newest.value = status));
  effect(() => {
    if (link.value !== "open") return;
    call<StudyStatus>("study.status").then((status) => void (newest.value = status), () => undefined);
  });
}

/** Changes one thing of the study that is set up. */
export const setStudy = <K extends keyof Study>(key: K, value: Study[K], label: string): Promise<void> => edit(`/study/study/${key}`, value, label);

/** Starts the touch, with the force for this window where it may have it; or ends it. */
export async function toggleTouch(session: Session): Promise<void> {
  if (session.touching) return void (await call("study.touch", { on: false }));
  if (feelStatus.value?.may_command_forces && !leaseIsMine.value) await takeForce();
  await call("study.touch", { on: true });
}

export const giveAnswer = (session: Session, answer: number): Promise<unknown> => call("study.answer", { trial: session.trial, answer });
