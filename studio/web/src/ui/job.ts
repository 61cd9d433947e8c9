// The long work of the server, as it goes (event "job").
import { signal, type ReadonlySignal } from "@preact/signals";
import { call, onEvent } from "../net/connection";

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

/** After the connection was lost nothing is known of the jobs there were. */
export const forgetJobs = () => (all.value = []);

/** The list with a job's news: changed in its place, or gone when it has ended. */
export function withJob(list: Job[], job: Job): Job[] {
  const ended = job.state !== "waiting" && job.state !== "running";
  if (ended) return list.filter(({ id }) => id !== job.id);
  return list.some(({ id }) => id === job.id) ? list.map((old) => (old.id === job.id ? job : old)) : [...list, job];
}
