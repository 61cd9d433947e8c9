// The long work of the server, as it goes (event "job").
import { signal, type ReadonlySignal } from "@preact/signals";
import { call, onEvent, Refusal } from "../net/connection";

export type JobState = "waiting" | "running" | "done" | "failed" | "cancelled";

export interface Job {
  id: number;
  title: string;
  stage: string;
  /** 0 … 1; negative: unknown. */
  fraction: number;
  state: JobState;
}

const all = signal<Job[]>([]);

/** Jobs that wait or run, oldest first. */
export const jobs: ReadonlySignal<Job[]> = all;

export const cancelJob = (id: number) => call("job.cancel", { job: id });

/** Listens to the server's jobs. Called once. */
export function followJobs(): void {
  onEvent("job", (job: Job) => (all.value = withJob(all.value, job)));
}

/** The jobs that run already, read after each connection. A server without such a list sends events. */
export async function readJobs(): Promise<void> {
  all.value = [];
  try {
    const list = await call<Job[]>("job.list");
    all.value = list.reduce(withJob, []);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
  }
}

/** The list with a changed job, or without it if it has ended. */
export function withJob(list: Job[], job: Job): Job[] {
  const ended = job.state !== "waiting" && job.state !== "running";
  if (ended) return list.filter(({ id }) => id !== job.id);
  return list.some(({ id }) => id === job.id) ? list.map((old) => (old.id === job.id ? job : old)) : [...list, job];
}
