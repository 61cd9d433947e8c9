// What the server states of itself.
import { signal, type ReadonlySignal } from "@preact/signals";
import { call } from "../net/connection";

export interface About {
  version: string;
  /** Name of the project's folder. */
  folder: string;
  /** What the studio was opened with, a name in the folder; null: the folder alone. */
  opened: string | null;
  /** False where this server only shows forces and commands none. */
  may_command_forces: boolean;
  client: number;
  /** What was wrong with the stored document, in words. */
  problems: string[];
}

const newest = signal<About | null>(null);
export const about: ReadonlySignal<About | null> = newest;

export async function readAbout(): Promise<About> {
  return (newest.value = await call<About>("studio.about"));
}
