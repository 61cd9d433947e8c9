// What comes from the server while a scan is open, gathered for the page's parts.
import { signal } from "@preact/signals";
import type { Block } from "../../net/block";
import { call, link, subscribe } from "../../net/connection";
import { LiveBuffer } from "../../plot/LiveBuffer";
import { Growing, RowCounter } from "./growing";
import { HostClock, Recent } from "./latency";
import type { ScanState } from "./scanState";

const kPing_ms = 3000;
const kPings = 4;
const kDoubt_ms = 25; // a clock that is less well known gives no delay
const kFigures_ms = 250;
const kSilent_ms = 2000;
const kPause_s = 0.5;
const kFewPoints = 200;
const kLongestPause_ms = 200;

export const state = signal<ScanState | null>(null);
/** The newest camera image, and the last scan worked out in full; null: there is none. */
export const image = signal<Block | null>(null);
export const refined = signal<Block | null>(null);

export const force = new LiveBuffer(1);
export const acceleration = new LiveBuffer(3);
export const rows = new RowCounter();

export const profile = new Growing(
  { s_m: 1e3, height_m: 1e6, sigma_m: 1e6, texture_m: 1e6, force_N: 1, speed_mps: 1e3 },
  "s_m",
  () => void askProfile(),
);
export const path = new Growing({ tip_m: 1, axis: 1, force_N: 1, state: 1 }, "tip_m", () => void askPath(), 3);
/** Grows when the profile has, as often as it can be drawn; the 3D view looks at `path` itself. */
export const profileVersion = signal(0);

/** From the sensor to the drawn frame, and how many rows have come and not come. */
export interface StreamFigures {
  median_ms: number;
  late_ms: number;
  rows: number;
  lost: number;
  /** From the tip's motion to the frame in which the profile has it. */
  profile_ms: number;
  profile_late_ms: number;
}
export const figures = signal<StreamFigures>({ median_ms: NaN, late_ms: NaN, rows: 0, lost: 0, profile_ms: NaN, profile_late_ms: NaN });

const clock = new HostClock();
const latencies = new Recent();
const profileLatencies = new Recent();
const undrawn_ns: number[] = []; // the motion of each block that is not drawn yet
let drawing = false;
let askedProfile = false;
let askedPath = false;
let heard_ms = 0;

/** Begins to listen; the function that it returns ends it. */
export function follow(): () => void {
  const ends = [
    subscribe("scan.state", (block) => (state.value = block.head as unknown as ScanState)),
    subscribe("scan.probe", takeRows),
    subscribe("scan.profile", takeProfile),
    subscribe("scan.pose", (block) => path.take(block)),
    subscribe("scan.image", (block) => (image.value = block)),
    subscribe("scan.refined", (block) => (refined.value = block.arrays.s_m || block.head.failure ? block : null)),
    link.subscribe((now) => now === "open" && void begin()),
  ];
  const ping = setInterval(() => void measure(), kPing_ms);
  const tell = setInterval(() => {
    if (performance.now() - heard_ms > kSilent_ms) latencies.clear();
    figures.value = {
      median_ms: latencies.quantile(0.5),
      late_ms: latencies.quantile(0.95),
      rows: rows.rows,
      lost: rows.lost,
      profile_ms: profileLatencies.quantile(0.5),
      profile_late_ms: profileLatencies.quantile(0.95),
    };
  }, kFigures_ms);
  return () => {
    clearInterval(ping);
    clearInterval(tell);
    ends.forEach((end) => end());
  };
}

/** The page is new, or the connection is back: what there is already. */
async function begin(): Promise<void> {
  rows.clear();
  latencies.clear();
  profileLatencies.clear();
  undrawn_ns.length = 0;
  await measure();
  const status = await call<{ open: boolean; refined: boolean }>("scan.status").catch(() => null);
  if (!status) return;
  if (status.refined) refined.value = await call<Block>("scan.refined").catch(() => null);
  if (status.open) await Promise.all([askProfile(), askPath()]);
}

async function measure(): Promise<void> {
  if (link.value !== "open") return;
  // A page that is busy hears an answer late: of some in a row one comes through quickly.
  for (let ping = 0; ping < kPings; ++ping) {
    const sent = performance.now();
    const answer = await call<{ t_ns: number }>("studio.ping").catch(() => null);
    if (answer) clock.add(sent, answer.t_ns, performance.now());
  }
}

async function askProfile(): Promise<void> {
  if (askedProfile) return;
  askedProfile = true;
  const all = await call<Block>("scan.profile").catch(() => null);
  askedProfile = false;
  if (!all) return;
  profile.take(all);
  void drawProfile();
}

async function askPath(): Promise<void> {
  if (askedPath) return;
  askedPath = true;
  const all = await call<Block>("scan.path").catch(() => null);
  askedPath = false;
  if (all) path.take(all);
}

function takeProfile(block: Block): void {
  const anew = block.head.generation !== profile.generation;
  const before = profile.length;
  profile.take(block);
  if (anew) {
    profileLatencies.clear();
    undrawn_ns.length = 0;
  }
  // A part of the past that comes at once, after a change of the settings, gives no delay.
  const grown = profile.length - before;
  if (!anew && grown > 0 && grown <= kFewPoints && !document.hidden) undrawn_ns.push(block.head.motion_ns as number);
  void drawProfile();
}

const nextFrame = () => new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));

/** Shows what the profile has grown to; what grows meanwhile is shown next, and half of the time is left for others. */
async function drawProfile(): Promise<void> {
  if (drawing) return;
  drawing = true;
  const start_ms = performance.now();
  await nextFrame();
  profileVersion.value = profile.version;
  const drawn_ns = undrawn_ns.splice(0);
  // The plot is drawn in this frame; the task after it begins when the frame has been handed on.
  await pause(0);
  const now_ms = performance.now();
  if (clock.known && clock.doubt_ms < kDoubt_ms) drawn_ns.forEach((motion_ns) => profileLatencies.add(now_ms - clock.toHere_ms(motion_ns)));
  await pause(Math.min(now_ms - start_ms, kLongestPause_ms));
  drawing = false;
  if (profileVersion.value !== profile.version) void drawProfile();
}

const pause = (time_ms: number) => new Promise<void>((resolve) => setTimeout(resolve, time_ms));

function takeRows(block: Block): void {
  heard_ms = performance.now();
  const t_s = block.arrays.t_s!;
  rows.take(block.head.sequence, t_s.length);
  const forces = block.arrays.force_N!;
  // After a pause the plots start again: no line goes across it.
  if (t_s.length > 0 && acceleration.length > 0 && t_s[0]! - acceleration.newest_s > kPause_s) {
    acceleration.clear();
    force.clear();
  }
  const when: number[] = [];
  const read: number[] = [];
  // A force sensor slower than the rows has nothing new in most of them.
  for (let row = 0; row < t_s.length; ++row) {
    if (!Number.isFinite(forces[row]!)) continue;
    when.push(t_s[row]!);
    read.push(forces[row]!);
  }
  force.append(when, [read]);
  const all = block.arrays.accel_mps2!;
  const axes = [0, 1, 2].map((axis) => Float32Array.from(t_s, (_t, row) => all[3 * row + axis]!));
  acceleration.append(t_s, axes);
  const newest_ns: number = block.head.newest_ns;
  // Drawn in the next frame; the task after it begins when that frame has been handed on.
  requestAnimationFrame(() => setTimeout(() => clock.known && clock.doubt_ms < kDoubt_ms && latencies.add(performance.now() - clock.toHere_ms(newest_ns))));
}
