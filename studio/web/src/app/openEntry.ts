import { edit, valueAt } from "../state/document";
import type { EntryKind } from "../ui/entries";
import { go } from "./go";
import { editToOpen, pageOf } from "./opened";

/** Chooses an entry of the folder on its page, and goes there. */
export async function openEntry(kind: EntryKind, name: string): Promise<void> {
  const page = pageOf(kind)!;
  const change = editToOpen(kind, name, valueAt(`/${page}`));
  if (change) await edit(change.path, change.value, change.label);
  go(page);
}
