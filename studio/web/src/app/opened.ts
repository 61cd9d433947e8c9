// What the studio was started with, chosen on its page.
import type { AlignSection } from "../pages/align/alignState";
import type { FeelSection } from "../pages/feel/feelChoices";
import { withScan, type ProcessSection } from "../pages/process/processing";
import type { EntryKind } from "../ui/entries";

export interface OpenedEdit {
  path: string;
  value: unknown;
  label: string;
}

const PAGE_OF: Partial<Record<EntryKind, string>> = { recording: "process", mesh: "align", scene: "feel" };

/** The page that an entry of the folder is opened on. */
export const pageOf = (kind: EntryKind): string | undefined => PAGE_OF[kind];

/** The edit of the page's section that chooses the entry; null where it is chosen already. */
export function editToOpen(kind: EntryKind, name: string, section: unknown): OpenedEdit | null {
  const label = `open ${name}`;
  if (kind === "mesh") {
    const align = section as AlignSection;
    if (align.mesh === name) return null;
    // Pose and picks of another mesh mean nothing here.
    const { T_mesh_world: _pose, registered: _registered, ...kept } = align;
    return { path: "/align", value: { ...kept, mesh: name, picks: [] }, label };
  }
  if (kind === "recording") {
    const process = section as ProcessSection;
    if (process.scans[process.current]?.recording === name) return null;
    const there = process.scans.find(({ recording }) => recording === name);
    return { path: "/process", value: withScan(process, there ?? { recording: name, segment: "" }), label };
  }
  if (kind === "scene") {
    const feel = section as FeelSection;
    if (feel.scene === name) return null;
    return { path: "/feel", value: { ...feel, scene: name, height_maps: [], textures: {} }, label };
  }
  return null;
}
