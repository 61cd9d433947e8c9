// The one addition that is under way in this window, and what came of the last.
import { signal } from "@preact/signals";
import { readEntries } from "../ui/entries";
import { complain, say } from "../ui/toast";
import type { Choice } from "./dropped";
import { sendFiles, Stopped, type Placed } from "./sendFiles";

export interface Adding {
  files: number;
  fraction: number;
}

/** Whether the dialog is open. */
export const adds = signal(false);
export const adding = signal<Adding | null>(null);
export const added = signal<Placed[]>([]);
let stopped = false;

export const stopAdding = (): void => void (stopped = true);

/** Adds them; what went wrong is shown to the user, and nothing was added then. */
export async function add(choice: Choice): Promise<void> {
  if (adding.value) return say("Files are being added already.", "Wait until they are added.");
  const { files, hidden } = choice;
  if (files.length === 0) return say(hidden > 0 ? "Hidden files are not added." : "This contains no files.");
  stopped = false;
  adding.value = { files: files.length, fraction: 0 };
  try {
    added.value = await sendFiles(
      files,
      (fraction) => (adding.value = { files: files.length, fraction }),
      () => stopped,
    );
    await readEntries();
    say(addedWords(added.value, hidden));
  } catch (error) {
    if (error instanceof Stopped) say("Nothing was added.");
    else complain(error);
  } finally {
    adding.value = null;
  }
}

export function addedWords(placed: readonly Placed[], hidden: number): string {
  const first = placed.slice(0, 3).map(({ from, name }) => (from === name ? name : `${from} as ${name}`));
  const more = placed.length > first.length ? ` and ${placed.length - first.length} more` : "";
  const left = hidden > 0 ? ` ${hidden} hidden ${hidden === 1 ? "file was" : "files were"} left out.` : "";
  return `Added ${first.join(", ")}${more}.${left}`;
}

/** True for a file that holds heights: an instrument's, or a table that may hold some. */
export const holdsHeights = (name: string): boolean => /\.(gsf|sdf|sur|pro|x3p|smd|tiff?)$/i.test(name) || isTable(name);

/** True for a table that the import can read. */
export const isTable = (name: string): boolean => /\.(csv|tsv|txt|dat|log)$/i.test(name) && !name.endsWith(".study.csv");
