// Plots with the same key: they show the same range of x, and have the same measuring cursors.
import { signal, type Signal } from "@preact/signals";
import type { Cursors } from "./cursors";
import type { Range } from "./zoom";

export interface Linked {
  /** What another plot of the group was zoomed to; null: it shows all. */
  followZoom(range: Range | null): void;
}

const groups = new Map<string, Set<Linked>>();
const cursors = new Map<string, Signal<Cursors | null>>();

/** Makes a plot one of a group; the function that it returns ends that. */
export function joinGroup(key: string, plot: Linked): () => void {
  const group = groups.get(key) ?? new Set();
  groups.set(key, group.add(plot));
  return () => void group.delete(plot);
}

/** Zooms the other plots of the group. */
export function zoomGroup(key: string, from: Linked, range: Range | null): void {
  for (const plot of groups.get(key) ?? []) if (plot !== from) plot.followZoom(range);
}

/** The measuring cursors of a group, or those of a plot without one. */
export function cursorsOf(key: string | undefined): Signal<Cursors | null> {
  if (!key) return signal(null);
  const found = cursors.get(key) ?? signal<Cursors | null>(null);
  cursors.set(key, found);
  return found;
}
