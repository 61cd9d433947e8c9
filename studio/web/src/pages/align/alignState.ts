// What the Align page knows in addition to the document: the open mesh and path, the last registration, what is being shown.
import { batch, computed, effect, signal } from "@preact/signals";
import type { VerdictEntry } from "../../measured/verdicts";
import { call, onEvent, Refusal, subscribe } from "../../net/connection";
import type { Block } from "../../net/block";
import { documentIsRead, edit, section } from "../../state/document";
import { project } from "../../state/project";
import { askShared, isCancelled } from "../../ui/askShared";
import { jobs } from "../../ui/job";
import { complain } from "../../ui/toast";
import type { AreaSection } from "./area";
import { noIterations, withBlock, type Iterations } from "./iterations";
import { latest } from "./latest";
import { missingWords } from "./missing";
import { openingKey } from "./openingKey";
import type { Pick } from "./picks";
import { samePose, type Frame, type Point, type Pose } from "./pose";
import type { Residuals } from "./residuals";
import { ownPoses, type ScanPose } from "./scans";

export interface AlignSection {
  paths: string[];
  mesh: string;
  /** "": the project's, unless the file states one. */
  mesh_unit: string;
  textures: string[];
  config: Record<string, string>;
  picks: Pick[];
  T_mesh_world?: Pose;
  registered?: { guess: Pose | null; near: boolean; T_mesh_world: Pose };
  /** Missing in what an older studio has kept. */
  area?: AreaSection;
  ran?: { guess: Pose | null; paths: string[]; mesh: string; mesh_unit: string; config: Record<string, string> };
}

export interface Solution {
  T_mesh_world: Pose;
  rms_m: number | null;
}

export interface RunResult extends Solution {
  run: number;
  guess: Pose | null;
  mean_m: number | null;
  points: number;
  outliers: number;
  iterations: number;
  converged: boolean;
  trustworthy: boolean;
  ambiguous: boolean;
  verdict: string;
  verdicts?: VerdictEntry[];
  certainty: string;
  undetermined: { description: string; sigma_m: number | null }[];
  runner_up: (Solution & { distance_m: number | null; turn_deg: number | null }) | null;
  problems: string[];
  scans?: ScanPose[];
}

/** The verdict on a pose that was set by hand. */
export interface Judged {
  T_mesh_world: Pose;
  rms_m: number | null;
  trustworthy: boolean;
  verdict: string;
  verdicts: VerdictEntry[];
}

export interface Six {
  shift_m: number[];
  turn_deg: number[];
}

export type Showing = "placed" | "iteration" | "best" | "runner_up";
export type Tool = "look" | "translate" | "rotate" | "pick";

export const align = section<AlignSection | undefined>("align");

export const opened = signal<Block | null>(null);
/** Also before the page has begun to. */
export const opening = signal(true);
/** Why it could not be opened; "": it could. */
export const openFault = signal("");
export const residuals = signal<Residuals | null>(null);
export const iterations = signal<Iterations>(noIterations);
export const result = signal<RunResult | null>(null);
/** The verdict on the pose that the path was moved to, once it is known; null while it is not. */
export const judged = signal<Judged | null>(null);
const registering = signal(false);
/** The registration under way, also one that another window or the studio itself has begun. */
export const runningJob = computed(() => jobs.value.find(({ title }) => title.startsWith("Registering")));
export const running = computed(() => registering.value || runningJob.value !== undefined);
export const showing = signal<Showing>("placed");
/** The iteration that is shown, from 0. */
export const scrub = signal(0);
export const ghost = signal(false);
/** What the path's colours stand for. */
export type Colouring = "distance" | "sigma" | "scan";
export const colouring = signal<Colouring>("distance");
/** Whether points at which scans overlap are marked. */
export const showOverlaps = signal(true);
/** Whether the areas of a scene that have a texture are drawn. */
export const showAreas = signal(true);
export const tool = signal<Tool>("look");
/** The point of the path, in the world, that waits for its point of the mesh. */
export const half = signal<Point | null>(null);
/** The point that rotations leave unchanged. */
export const about = signal<"middle" | "origin">("middle");
export const six = signal<Six | null>(null);

const draft = signal<Pose | null>(null);
const draftSix = signal<Six | null>(null);

/** Why scan and mesh cannot be worked on yet; "" if they can. */
export const missing = computed(() => missingWords(align.value, opened.value !== null, opening.value));

export const frame = computed<Frame | null>(() => {
  const head = opened.value?.head;
  return head ? { middle_world_m: head.middle_world_m, origin_m: head.origin_m } : null;
});

/** The pose that is the user's: as it is dragged, as decided, or where one begins. */
export const placed = computed<Pose | null>(() => draft.value ?? align.value?.T_mesh_world ?? opened.value?.head.start ?? null);

export const shown = computed<Pose | null>(() => {
  if (showing.value === "iteration") return iterations.value.poses[scrub.value] ?? placed.value;
  if (showing.value === "best") return result.value?.T_mesh_world ?? placed.value;
  if (showing.value === "runner_up") return result.value?.runner_up?.T_mesh_world ?? placed.value;
  return placed.value;
});

/** Poses of the scans of a registration with several placements, while it is shown: one a path. */
export const shownPoses = computed<Pose[] | null>(() =>
  showing.value === "best" ? ownPoses(result.value?.scans, align.value?.paths.length ?? 0) : null,
);

/** The other solution of the two, while one of them is shown. */
export const ghostPose = computed<Pose | null>(() => {
  const other = result.value?.runner_up;
  if (!ghost.value || !other) return null;
  return showing.value === "runner_up" ? result.value!.T_mesh_world : other.T_mesh_world;
});

/** True where the pose is still that of the registration it was taken from. */
export const isRegistered = computed(() => samePose(align.value?.T_mesh_world, align.value?.registered?.T_mesh_world));

/** True where the path was moved to another pose than the registered one: the registration's verdict is not about it. */
export const isMoved = computed(
  () => result.value !== null && align.value?.T_mesh_world !== undefined && !samePose(align.value.T_mesh_world, result.value.T_mesh_world),
);

/** Changes the point that rotations leave unchanged; the six numbers are then others. */
export function turnAbout(what: "middle" | "origin"): void {
  six.value = null;
  about.value = what;
}

const pivot = (): Point => (about.value === "middle" ? frame.value!.middle_world_m : [0, 0, 0]);
export const shownSix = computed<Six | null>(() => draftSix.value ?? six.value);

/** Iterations come faster than plots and 3D pictures are worth drawing. */
const kPicture_ms = 150;
/** A pose is judged once it has been left alone for this long. */
const kSettled_ms = 500;
const POSE_PATH = "/align/T_mesh_world";
const mover = latest(
  ({ pose, gesture }: { pose: Pose; gesture: string }) => edit(POSE_PATH, pose, "move the path", gesture).catch(complain),
  () => (draft.value = null),
);

/** Moves the path; called as often as one likes. */
export function move(pose: Pose, gesture: string): void {
  showing.value = "placed";
  draft.value = pose;
  mover({ pose, gesture });
}

const turner = latest(
  async ({ wanted, gesture }: { wanted: Six; gesture: string }) => {
    try {
      const { pose, shift_m, turn_deg } = await call("align.sliders", { ...wanted, about_world_m: pivot() });
      draft.value = pose;
      six.value = { shift_m, turn_deg };
      await edit(POSE_PATH, pose, "move the path", gesture);
    } catch (error) {
      complain(error);
    }
  },
  () => {
    draft.value = null;
    draftSix.value = null;
  },
);

/** Poses the path by the six numbers. */
export function moveBySix(wanted: Six, gesture: string): void {
  showing.value = "placed";
  draftSix.value = wanted;
  turner({ wanted, gesture });
}

const quietly = (error: unknown): void => {
  if (!isCancelled(error)) complain(error);
};

let openings = 0;

/** Opens what the document names, again when that changes. */
export async function open(): Promise<void> {
  const number = ++openings;
  const isNewest = () => number === openings;
  opening.value = true;
  openFault.value = "";
  try {
    const block = await askShared<Block>("align.open", {}, { title: `Opening ${align.value?.mesh}`, wanted: isNewest });
    if (!isNewest()) return;
    opened.value = block;
    const last = await call<RunResult | null>("align.result");
    const all = last ? withBlock(noIterations, await call<Block>("align.iterations")) : noIterations;
    if (!isNewest()) return;
    result.value = last;
    iterations.value = all;
  } catch (error) {
    if (!isNewest()) return;
    forget();
    if (error instanceof Refusal && !isCancelled(error)) openFault.value = `${error.message}. ${error.hint}`;
    else quietly(error);
  } finally {
    if (isNewest()) opening.value = false;
  }
}

/** Nothing is open, and nothing is known of it. */
function forget(): void {
  opened.value = null;
  result.value = null;
  iterations.value = noIterations;
  half.value = null;
}

/** The document names nothing that could be opened; what was asked for before comes too late. */
function close(): void {
  ++openings;
  opening.value = false;
  openFault.value = "";
  forget();
}

export async function register(fromHere: boolean): Promise<void> {
  const before = { result: result.value, iterations: iterations.value };
  registering.value = true;
  iterations.value = noIterations;
  result.value = null;
  scrub.value = 0;
  showing.value = "iteration";
  try {
    result.value = await call<RunResult>("align.run", { guess: fromHere });
    showing.value = "best";
  } catch (error) {
    // What was found before is as good as it was.
    result.value = before.result;
    iterations.value = before.iterations;
    showing.value = "placed";
    quietly(error);
  } finally {
    registering.value = false;
  }
}

export async function take(solution: "best" | "runner_up"): Promise<void> {
  await call("align.accept", { solution });
  showing.value = "placed";
}

/** Follows server and document while the page is shown; the function that it returns ends it. */
export function followAlign(): () => void {
  const measurer = latest(async ({ pose, poses }: { pose: Pose; poses: Pose[] | null }) => {
    try {
      const block = await call<Block>("align.residuals", poses ? { pose, poses } : { pose });
      const { mean_m, rms_m, most_m, rms_sigma, median_sigma_m, overlap_m } = block.head as Residuals;
      const { distance_m, sigma_m, overlap } = block.arrays as { distance_m: Float32Array; sigma_m: Float32Array; overlap: Uint8Array };
      residuals.value = { distance_m, sigma_m, overlap, mean_m, rms_m, most_m, rms_sigma, median_sigma_m, overlap_m };
    } catch (error) {
      residuals.value = null;
      if (!opening.value) quietly(error);
    }
  });
  const reader = latest(async (pose: Pose) => {
    const { shift_m, turn_deg } = await call<Six>("align.sliders", { pose, about_world_m: pivot() });
    six.value = { shift_m, turn_deg };
  });
  const judge = latest(async (pose: Pose) => {
    try {
      const found = await call<Judged>("align.judge", { pose });
      if (samePose(found.T_mesh_world, align.value?.T_mesh_world)) judged.value = found;
    } catch (error) {
      quietly(error);
    }
  });
  let judging: ReturnType<typeof setTimeout> | undefined;
  const news: Block[] = [];
  let timer: ReturnType<typeof setTimeout> | undefined;
  const takeNews = () => {
    timer = undefined;
    batch(() => {
      iterations.value = news.splice(0).reduce(withBlock, iterations.value);
      if (running.value || showing.value !== "iteration") scrub.value = Math.max(0, iterations.value.poses.length - 1);
    });
  };
  const what = computed(() => (documentIsRead.value ? openingKey(align.value ?? {}, project.value.mesh_unit) : ""));
  const ends = [
    effect(() => {
      showing.value = "placed";
      // The edit that this follows is sent first: it is under way in the caller.
      if (what.value) queueMicrotask(() => void open());
      else close();
    }),
    effect(() => {
      if (opened.value && shown.value) measurer({ pose: shown.value, poses: shownPoses.value });
      else residuals.value = null;
    }),
    effect(() => {
      const pose = placed.value;
      const isOpen = opened.value && about.value;
      if (isOpen && pose && !draftSix.value) reader(pose);
    }),
    effect(() => {
      clearTimeout(judging);
      judged.value = null;
      const pose = align.value?.T_mesh_world;
      if (!pose || !opened.value || !isMoved.value || running.value) return;
      judging = setTimeout(() => judge(pose), kSettled_ms);
    }),
    subscribe("align.iteration", (block) => {
      news.push(block);
      timer ||= setTimeout(takeNews, kPicture_ms);
    }),
    () => clearTimeout(timer),
    () => clearTimeout(judging),
    onEvent("align.result", (found: RunResult | null) => {
      result.value = found;
      if (found) return;
      // Undone, or of other files.
      iterations.value = noIterations;
      if (!running.value) showing.value = "placed";
    }),
  ];
  return () => ends.forEach((end) => end());
}
