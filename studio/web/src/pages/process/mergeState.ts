// The merge that is shown, kept while other tabs are looked at.
import { signal } from "@preact/signals";
import type { Block } from "../../net/block";
import { call } from "../../net/connection";
import { mergeKey } from "./merging";
import type { ProcessSection } from "./processing";

export interface Merged {
  block: Block;
  /** The inputs that it was made of. */
  key: string;
}

export const merged = signal<Merged | null>(null);
export const merging = signal(false);
/** The reason why no merge exists yet; "" if one exists or none was requested. */
export const mergeFault = signal("");

/** The title of the server's job. */
export const kMergeJob = "Merge strokes";

export async function merge(section: ProcessSection): Promise<void> {
  const key = mergeKey(section);
  merging.value = true;
  mergeFault.value = "";
  try {
    merged.value = { block: await call<Block>("process.merge"), key };
  } catch (error) {
    if ((error as Error).message === "cancelled") return;
    merged.value = null;
    mergeFault.value = (error as Error).message;
    throw error;
  } finally {
    merging.value = false;
  }
}
