// What the server states of the run: its status, and the newest state while it continues. The same for all pages.
import { effect, signal, type ReadonlySignal } from "@preact/signals";
import type { VerdictEntry } from "../../measured/verdicts";
import type { Block } from "../../net/block";
import { call, link, onEvent, subscribe } from "../../net/connection";
import { followLease, leaseIsMine, takeForce, thisClient } from "../../state/lease";

export interface FeelStatus {
  state: "idle" | "opening" | "running" | "stopping";
  run: number;
  device: string;
  device_model: string;
  rate_Hz: number;
  real_forces: boolean;
  /** Whose run it is. */
  owner: number | null;
  /** What is rendered is a trial of a study, not what this page shows. */
  visited: boolean;
  /** Between two trials, without force. */
  held: boolean;
  loading: boolean;
  /** Another number where the scene is drawn differently. */
  revision: number | null;
  /** How each texture of the scene becomes a force. */
  models: string[];
  title: string;
  problem: string;
  hint: string;
  warnings: string[];
  may_command_forces: boolean;
  max_force_N: number;
  most_force_N: number;
  log: string;
  last_run: LastRun | null;
}

export interface LastRun {
  end: string;
  text: string;
  duration_s: number;
  verdicts: VerdictEntry[];
  figures: { force: { peak_N: number; rms_N: number; peak_out_N: number }; safety: Record<string, number> };
}

export type Vector = [number, number, number];

/** One frame of the topic "feel.state". */
export interface FeelState {
  run: number;
  t_s: number;
  status: "ready" | "stalled" | "fault" | "ended";
  gain: number;
  limited: string[];
  touching: boolean;
  sticking: boolean;
  starts_inside: boolean;
  height_m: number;
  way_m: number;
  speed_mps: number;
  late_p99_us: number;
  late_max_us: number;
  skipped: number;
  point: Vector;
  proxy: Vector;
  contact: Vector;
  texture: Vector;
  friction: Vector;
  out: Vector;
}

const newestStatus = signal<FeelStatus | null>(null);
const newestState = signal<FeelState | null>(null);
export const feelStatus: ReadonlySignal<FeelStatus | null> = newestStatus;
/** Null while nothing is rendered. */
export const feelState: ReadonlySignal<FeelState | null> = newestState;

const vector = (block: Block, name: string): Vector => Array.from(block.arrays[name]!) as Vector;

export function stateOf(block: Block): FeelState {
  return {
    ...(block.head as unknown as FeelState),
    point: vector(block, "p_world_m"),
    proxy: vector(block, "proxy_m"),
    contact: vector(block, "contact_N"),
    texture: vector(block, "texture_N"),
    friction: vector(block, "friction_N"),
    out: vector(block, "out_world_N"),
  };
}

/** Whether this window's force is let through to the run. */
export const commandsRun = (): boolean =>
  newestStatus.value?.state === "running" && leaseIsMine.value && newestStatus.value.owner === thisClient.value;

export const isActive = (status: FeelStatus | null): boolean => status !== null && status.state !== "idle";

function take(status: FeelStatus): void {
  newestStatus.value = status;
  if (status.state !== "running" && status.state !== "stopping") newestState.value = null;
}

let follows = false;

/** Begins to listen; more calls do nothing. */
export function followFeel(): void {
  if (follows) return;
  follows = true;
  followLease();
  onEvent("feel", take);
  subscribe("feel.state", (block) => {
    if (newestStatus.value?.state !== "idle") newestState.value = stateOf(block);
  });
  effect(() => {
    if (link.value === "open") call<FeelStatus>("feel.status").then(take, () => undefined);
    else newestState.value = null;
  });
}

/** Starts what the document states, with the force for this window where it may have it. */
export async function startFeeling(): Promise<void> {
  if (newestStatus.value?.may_command_forces && !leaseIsMine.value) await takeForce();
  take(await call<FeelStatus>("feel.start"));
}

/** Takes the force, and with it a run that continues without force. */
export async function takeRun(): Promise<void> {
  if (!(await takeForce())) throw new Error("Another window has the force. Release it there first.");
  if (newestStatus.value?.state === "running") await call("feel.take");
}

/** Any window may stop. */
export const stopFeeling = (): Promise<unknown> => call("feel.stop");

const CAUSES: Record<string, string> = {
  fault: "device fault",
  "non-finite": "not a number",
  stale: "no data from the device",
  ending: "ending",
  "soft-start": "soft start",
  passivity: "damped",
  "force-limit": "at the force limit",
  "rate-limit": "rate-limited",
  "not-permitted": "not permitted",
  implausible: "implausible position",
};

export const causeWords = (cause: string): string => CAUSES[cause] ?? cause;

/** How the watchdogs stand, in a word, and how bad that is. */
export function watchdog(state: FeelState): { lamp: "good" | "warn" | "bad"; word: string } {
  const serious = ["fault", "non-finite", "stale", "implausible", "not-permitted", "ending"].find((cause) => state.limited.includes(cause));
  if (serious) return { lamp: serious === "not-permitted" || serious === "ending" ? "warn" : "bad", word: causeWords(serious) };
  if (state.starts_inside) return { lamp: "warn", word: "inside the object: leave it first" };
  const slight = state.limited[0];
  return slight ? { lamp: "warn", word: causeWords(slight) } : { lamp: "good", word: "no fault" };
}

/** The state of the force, for the header and the panel alike. */
export function forceWords(status: FeelStatus | null, state: FeelState | null, connected: boolean, mine: boolean): { lamp: "off" | "good" | "warn" | "bad" | "busy"; word: string } {
  if (!connected) return { lamp: "off", word: "ended" };
  if (!status || status.state === "idle") return { lamp: "off", word: "off" };
  if (status.state === "opening") return { lamp: "busy", word: "starting" };
  if (status.state === "stopping") return { lamp: "busy", word: "stopping" };
  if (status.held) return { lamp: "busy", word: "between trials" };
  if (!state) return { lamp: "busy", word: "running" };
  if (!status.may_command_forces) return { lamp: "warn", word: "display only" };
  const { lamp, word } = watchdog(state);
  if (state.limited.includes("not-permitted") && lamp === "warn") return { lamp, word: mine ? "another window's run" : "no window has it" };
  return { lamp, word };
}

export const length3 = ([x, y, z]: Vector): number => Math.hypot(x, y, z);
