// What the project's folder holds.
import { signal, type ReadonlySignal } from "@preact/signals";
import { call, onEvent } from "../net/connection";
import { complain } from "./toast";

export type EntryKind = "recording" | "scene" | "mesh" | "texture" | "result" | "image" | "study" | "study-log" | "table" | "surface";

export interface Entry {
  kind: EntryKind;
  /** Relative to the project's folder. */
  name: string;
}

const all = signal<Entry[]>([]);
export const entries: ReadonlySignal<Entry[]> = all;

/** Listens to changes of the folder. Called once. */
export function followEntries(): void {
  onEvent("entries", () => void readEntries());
}

export async function readEntries(): Promise<void> {
  try {
    all.value = await call<Entry[]>("project.entries");
  } catch (error) {
    complain(error);
  }
}
