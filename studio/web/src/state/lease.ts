// The lease of the force: one window at a time may command forces, as long as its heartbeats come. Taken by the user's
// word, given back when the page is hidden or left; never taken back by itself (docs/safety.md).
import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import { call, link, onEvent } from "../net/connection";

const kBeat_ms = 100;

const owner = signal<number | null>(null);
const me = signal<number | null>(null);
const held = signal(false);
let timer = 0;

/** How the server calls this window. */
export const thisClient: ReadonlySignal<number | null> = me;
/** Whether this window has the force. */
export const leaseIsMine: ReadonlySignal<boolean> = held;
/** Whether another window has it. */
export const leaseIsOthers = computed(() => !held.value && owner.value !== null && owner.value !== me.value);

/** Takes out the force; true if this window has it then. */
export async function takeForce(): Promise<boolean> {
  const { mine } = await call<{ mine: boolean }>("lease.acquire");
  held.value = mine;
  if (mine && !timer) timer = window.setInterval(() => void beat(), kBeat_ms);
  return mine;
}

/** Gives it back; the force ramps to zero. */
export function giveForce(): void {
  if (!held.value) return;
  lose();
  call("lease.release").catch(() => undefined);
}

function lose(): void {
  held.value = false;
  window.clearInterval(timer);
  timer = 0;
}

async function beat(): Promise<void> {
  try {
    const { mine } = await call<{ mine: boolean }>("lease.heartbeat");
    if (!mine) lose();
  } catch {
    lose();
  }
}

let follows = false;

/** Begins to listen; more calls do nothing. */
export function followLease(): void {
  if (follows) return;
  follows = true;
  onEvent("lease", (data: { owner: number | null }) => {
    owner.value = data.owner;
    if (held.value && me.value !== null && data.owner !== me.value) lose();
  });
  effect(() => {
    if (link.value !== "open") return lose();
    call<{ client: number }>("studio.about").then(
      (about) => void (me.value = about.client),
      () => undefined,
    );
  });
  document.addEventListener("visibilitychange", () => document.hidden && giveForce());
  window.addEventListener("pagehide", giveForce);
}
