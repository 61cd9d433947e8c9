// Short messages to the user, shown in a corner and read out.
import { signal } from "@preact/signals";
import { Refusal } from "../net/connection";

export interface Toast {
  id: number;
  kind: "note" | "error";
  message: string;
  hint: string;
}

const kNoteShown_ms = 6000;
const kErrorShown_ms = 20000;
const kMost = 5;
const kCancelled = "cancelled";

export const toasts = signal<Toast[]>([]);
let nextId = 1;

/** States that something happened; goes away by itself. */
export function say(message: string, hint = ""): void {
  add({ kind: "note", message, hint }, kNoteShown_ms);
}

/** Shows what went wrong and what to do next; not that a newer request has taken the place of an older one. */
export function complain(error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  if (message === kCancelled) return;
  const hint = error instanceof Refusal ? error.hint : "";
  if (toasts.value.some((toast) => toast.kind === "error" && toast.message === message)) return;
  add({ kind: "error", message, hint }, kErrorShown_ms);
}

export function dismiss(id: number): void {
  toasts.value = toasts.value.filter((toast) => toast.id !== id);
}

function add(toast: Omit<Toast, "id">, shown_ms: number): void {
  const id = nextId++;
  toasts.value = [...toasts.value, { id, ...toast }].slice(-kMost);
  setTimeout(() => dismiss(id), shown_ms);
}
