// The document: all that the user decides, kept by the server, the same in every browser (docs/studio-protocol.md).
import { computed, signal, type ReadonlySignal } from "@preact/signals";
import { call, onEvent } from "../net/connection";

const whole = signal<Record<string, any>>({});
const undoWords = signal("");
const redoWords = signal("");
const read = signal(false);

export const documentIsRead: ReadonlySignal<boolean> = read;
/** What undo and redo would do, in words; empty: nothing. */
export const undoLabel: ReadonlySignal<string> = undoWords;
export const redoLabel: ReadonlySignal<string> = redoWords;

/** A page's section, as a signal. */
export function section<T = any>(name: string): ReadonlySignal<T> {
  return computed(() => whole.value[name] as T);
}

/** The value at a path like "/align/T_mesh_world". */
export function valueAt(path: string): any {
  return parts(path).reduce((value: any, key) => value?.[key], whole.value);
}

/**
 * Changes the document here at once and at the server; the server's word is final. Edits of one `gesture` (a slider
 * being dragged) are one step for undo.
 */
export async function edit(path: string, value: unknown, label: string, gesture = ""): Promise<void> {
  // First the server: what a change here sets off calls it, and must find it changed there.
  const told = call("document.edit", { path, value, label, gesture });
  whole.value = replaced(whole.value, parts(path), value);
  try {
    await told;
  } catch (error) {
    await readDocument();
    throw error;
  }
}

export const undo = () => call("document.undo");
export const redo = () => call("document.redo");

let gestures = 0;
/** A name for the edits of one drag. */
export const newGesture = () => `gesture ${++gestures} ${Date.now()}`;

export async function readDocument(): Promise<void> {
  take(await call("document.read"));
}

function take(state: any): void {
  whole.value = state.value;
  undoWords.value = state.undo;
  redoWords.value = state.redo;
  read.value = true;
}

/** Follows the server's document. Called once, and again whenever the connection is back. */
export function followDocument(): void {
  onEvent("document", (change) => {
    whole.value = replaced(whole.value, parts(change.path), change.value);
    undoWords.value = change.undo;
    redoWords.value = change.redo;
  });
}

function parts(path: string): string[] {
  return path
    .split("/")
    .slice(1)
    .map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
}

/** A copy with the value at a path replaced, or taken out where it is null; what is not on the path is shared. */
export function replaced(tree: any, path: string[], value: unknown): any {
  if (path.length === 0) return value;
  const [key, ...rest] = path as [string, ...string[]];
  if (Array.isArray(tree)) {
    const copy = [...tree];
    const index = key === "-" ? copy.length : Number(key);
    if (rest.length === 0 && value === null) copy.splice(index, 1);
    else copy[index] = replaced(copy[index], rest, value);
    return copy;
  }
  const copy = { ...(tree ?? {}) };
  if (rest.length === 0 && value === null) delete copy[key];
  else copy[key] = replaced(copy[key], rest, value);
  return copy;
}
