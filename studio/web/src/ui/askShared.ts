// Calls whose work on the server is one for all windows: a question of another window ends ours with "cancelled".
import { effect } from "@preact/signals";
import { call } from "../net/connection";
import { jobs, type Job } from "./job";

const kMostRepeats = 3;
const kPause_ms = 400;
const kLongerPause = 3; // each one than the one before, so that long work of the other window ends
/** A job of another window is waited for at most this long. */
const kLongestJob_ms = 60_000;

export interface Asking {
  /** How the title of the server's job begins; "": the job has no title, so nobody can cancel it. */
  title?: string;
  /** False once the answer is not needed any more. */
  wanted(): boolean;
}

export const isCancelled = (error: unknown): boolean => error instanceof Error && error.message === "cancelled";

/**
 * The newer job is announced before the older one's answer, and that one's end after it: two jobs of a title are a
 * question that another one has replaced, a single one was cancelled by a person.
 */
export const isReplaced = (list: readonly Job[], title: string): boolean => list.filter((job) => job.title.startsWith(title)).length > 1;

/** The answer of a call, asked again up to three times where another window's question has replaced it. */
export async function askShared<T>(name: string, args: Record<string, unknown>, { title = "", wanted }: Asking): Promise<T> {
  for (let repeats = 0; ; ++repeats) {
    try {
      return await call<T>(name, args);
    } catch (error) {
      const again = isCancelled(error) && repeats < kMostRepeats && wanted() && (title === "" || isReplaced(jobs.value, title));
      if (!again) throw error;
      // Two windows that ask again at once would replace each other again.
      await (title === "" ? pause(kPause_ms * kLongerPause ** repeats * (0.5 + Math.random())) : endOf(title));
      if (!wanted()) throw error;
    }
  }
}

const pause = (wait_ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, wait_ms));

/** When no job of this title is under way any more. */
function endOf(title: string): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(finish, kLongestJob_ms);
    let end: (() => void) | undefined;
    let isOver = false;
    function finish() {
      isOver = true;
      clearTimeout(timer);
      end?.();
      resolve();
    }
    end = effect(() => {
      if (!isOver && !jobs.value.some((job) => job.title.startsWith(title))) queueMicrotask(finish);
    });
  });
}
