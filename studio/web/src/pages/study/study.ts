// What a study is, the state of a session and its results, as the server sends them (docs/studio-study.md), and the words for them.
import type { Series } from "../../plot/series";
import { number, withError } from "../../ui/format";

export type Method = "pairs" | "staircase" | "rating";

export interface Study {
  name: string;
  question: string;
  stimuli: string[];
  object: string;
  /** What participants agree to before the first trial; "": they are not asked. */
  consent: string;
  method: Method;
  repetitions: number;
  seed: number;
  break_every: number;
  dates: boolean;
  staircase: Record<string, number | string>;
  presentation: Record<string, number | string>;
}

export interface StudySection {
  study: Study;
  participant: string;
}

export interface Session {
  name: string;
  method: Method;
  question: string;
  object: string;
  participant: string;
  device: string;
  trial: number | null;
  /** The number of trials; null if it is known only at the end. */
  of: number | null;
  answers: number;
  touching: boolean;
  ready: boolean;
  touched: boolean;
  /** Pressed with force for long enough. */
  touched_a: boolean;
  touched_b: boolean;
  /** All textures of the trial were: an answer is accepted. */
  may_answer: boolean;
  may_take_back: boolean;
}

export interface StudyStatus {
  phase: "none" | "reading" | "paused" | "running" | "finished";
  why: "" | "pause" | "break" | "restart";
  log: string;
  last_log: string;
  problem: string;
  hint: string;
  session: Session | null;
}

export interface Share {
  count: number;
  trials: number;
  share: number | null;
  low: number;
  high: number;
}

export interface PairShare extends Share {
  /** Places among the stimuli; the share is that of the first. */
  first: number;
  second: number;
}

export interface Track {
  stimulus: number;
  repetition: number;
  levels: number[];
  correct: boolean[];
  reversals: number[];
  done: boolean;
  threshold: number | null;
  error_ln: number | null;
  pairs: number;
  at_limit: boolean;
}

export interface Rating {
  stimulus: number;
  count: number;
  counts: number[];
  mean?: number;
  deviation?: number | null;
  low?: number;
  high?: number;
}

export interface StudyResults {
  log: string;
  name: string;
  method: Method;
  parameter: string;
  question: string;
  object: string;
  participant: string;
  run: number;
  stimuli: string[];
  answers: number;
  whole: boolean;
  median_response_s: number | null;
  problems: string[];
  left?: Share;
  wins?: (number | null)[][];
  pairs?: PairShare[];
  worths_exist?: boolean;
  worths?: { worth_ln: number; error_ln: number }[];
  target?: number;
  tracks?: Track[];
  ratings?: Rating[];
}

export const RATINGS = [1, 2, 3, 4, 5, 6, 7] as const;

/** How many trials a study has, at most for a staircase. */
export function trialsOf({ method, stimuli, repetitions, staircase }: Study): number {
  const n = stimuli.length;
  if (method === "pairs") return repetitions * n * Math.max(0, n - 1);
  if (method === "rating") return repetitions * n;
  return repetitions * n * Number(staircase.most_trials ?? 0);
}

/** The trials in words. */
export function trialWords(study: Study): string {
  const trials = trialsOf(study);
  if (study.method === "staircase") return `at most ${trials} trials`;
  return trials === 1 ? "1 trial" : `${trials} trials`;
}

/** Why a study cannot begin yet; empty: it can. */
export function lackOf(study: Study, participant: string): string {
  if (study.method === "pairs" && study.stimuli.length < 2) return "Choose at least two textures.";
  if (study.stimuli.length === 0) return "Choose a texture.";
  if (participant === "") return "Enter a code for the participant.";
  return "";
}

export const isCode = (text: string): boolean => /^[A-Za-z0-9_-]{1,40}$/.test(text);
export const isStudyName = (text: string): boolean => /^[A-Za-z0-9_-]{1,60}$/.test(text);

/** A list with one name more, or without it. */
export const toggled = (names: readonly string[], name: string): string[] =>
  names.includes(name) ? names.filter((one) => one !== name) : [...names, name];

/** A file as it is shown: without its ending. */
export const stimulusName = (file: string): string => file.replace(/\.texture\.json$|\.png$|\.pgm$/, "");

/** The answer that a key gives; null: none. */
export function answerOfKey(method: Method, key: string): number | null {
  if (method === "rating") return /^[1-7]$/.test(key) ? Number(key) : null;
  if (key === "1" || key === "ArrowLeft") return 0;
  if (key === "2" || key === "ArrowRight") return 1;
  return null;
}

export const answersWords = (count: number): string => (count === 1 ? "1 answer" : `${count} answers`);

export function progressWords({ trial, of, answers }: Session): string {
  if (trial === null) return answersWords(answers);
  return of === null ? `Trial ${trial}` : `Trial ${trial} of ${of}`;
}

/** What comes next; `held`: the force is at zero because the textures are being laid. */
export function adviceOf(session: Session, held: boolean): string {
  const answer = session.method === "rating" ? "answer with 1 to 7" : "answer with 1 or 2";
  if (!session.touching) return session.may_answer ? `Press Space to touch again, or ${answer}.` : "Press Space to touch.";
  if (!session.ready && !held) return "No force is rendered, because this window does not have the force. Take it, then continue.";
  if (!session.ready) return "Please wait until the textures are ready.";
  if (session.method === "rating") return session.may_answer ? `Touch the real object too, then ${answer}.` : "Press on the texture.";
  if (session.may_answer) return `Both are touched: ${answer}, or continue to touch.`;
  if (session.touched_a !== session.touched_b) return `Now press on ${session.touched_a ? "B, right" : "A, left"}.`;
  return "Touch both: press on A and on B.";
}

const PAUSES: Record<string, string> = {
  pause: "Paused",
  break: "Break",
  restart: "The session continues from the same trial",
};
export const pauseWords = (why: string): string => PAUSES[why] ?? "Paused";

const PARAMETERS: Record<string, string> = {
  height: "height, against a flat surface",
  "height-difference": "relative difference of height",
  "stiffness-difference": "relative difference of stiffness",
  "friction-difference": "relative difference of friction",
};
export const parameterWords = (parameter: string): string => PARAMETERS[parameter] ?? parameter;

/** "0.31 (0.25 to 0.39)": a threshold with the ends of its standard error, which is a factor. */
export function thresholdWords({ threshold, error_ln, at_limit }: Pick<Track, "threshold" | "error_ln" | "at_limit">): string {
  if (at_limit) return "none: at a limit";
  if (threshold === null) return "–";
  if (error_ln === null) return number(threshold, 3);
  return `${number(threshold, 3)} (${number(threshold * Math.exp(-error_ln), 3)} to ${number(threshold * Math.exp(error_ln), 3)})`;
}

const percent = (share: number): string => number(100 * share, 3);

/** "62 % (41 to 79)": a share with its interval. */
export const shareWords = ({ share, low, high }: Share): string =>
  share === null ? "–" : `${percent(share)}\u202f% (${percent(low)} to ${percent(high)})`;

export const worthWords = ({ worth_ln, error_ln }: { worth_ln: number; error_ln: number }): string => withError(worth_ln, error_ln);

/** A track as a plot shows it: the level of each trial, the reversals, the threshold with its error. */
export function trackSeries({ levels, reversals, threshold, error_ln }: Track): Series[] {
  const trials = levels.map((_, index) => index + 1);
  const out: Series[] = [
    { label: "level", x: trials, y: levels, kind: "step", colour: 1 },
    { label: "reversals", x: reversals.map((index) => index + 1), y: reversals.map((index) => levels[index]!), kind: "points", colour: 2 },
  ];
  if (threshold !== null && levels.length > 0) {
    const both = (value: number) => [value, value];
    const band = error_ln === null ? {} : { lo: both(threshold * Math.exp(-error_ln)), hi: both(threshold * Math.exp(error_ln)) };
    out.push({ label: "threshold", x: [1, levels.length], y: both(threshold), dashed: true, colour: 3, ...band });
  }
  return out;
}
