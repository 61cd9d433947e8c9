// The guided first scan: whether it is on, in this window.
import { signal } from "@preact/signals";

export const guided = signal(false);
