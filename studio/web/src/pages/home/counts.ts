import type { Entry, EntryKind } from "../../ui/entries";

const WORDS: Partial<Record<EntryKind, [string, string]>> = {
  recording: ["recording", "recordings"],
  result: ["result", "results"],
  texture: ["texture", "textures"],
  mesh: ["mesh", "meshes"],
  scene: ["scene", "scenes"],
  surface: ["surface", "surfaces"],
  study: ["study", "studies"],
  "study-log": ["study log", "study logs"],
};

/** "2 recordings, 1 mesh": what the folder has, without kinds that it has none of. */
export function counts(entries: readonly Entry[]): string {
  const parts = Object.entries(WORDS).flatMap(([kind, [one, more]]) => {
    const count = entries.filter((entry) => entry.kind === kind).length;
    return count === 0 ? [] : [`${count} ${count === 1 ? one : more}`];
  });
  return parts.length > 0 ? `${parts.join(", ")}.` : `${entries.length} ${entries.length === 1 ? "file" : "files"}.`;
}
