import { describe, expect, it, test } from "vitest";
import { editToOpen } from "../src/app/opened";
import { routeOf } from "../src/app/routes";
import { forceWords, type FeelStatus } from "../src/pages/feel/feelStore";
import {
  adviceOf,
  answerOfKey,
  isCode,
  isStudyName,
  lackOf,
  progressWords,
  shareWords,
  stimulusName,
  thresholdWords,
  toggled,
  trackSeries,
  trialsOf,
  trialWords,
  type Session,
  type Study,
} from "../src/pages/study/study";

const study = (changes: Partial<Study> = {}): Study => ({
  name: "study",
  question: "?",
  stimuli: ["a.texture.json", "b.png", "c.pgm"],
  object: "",
  consent: "",
  method: "pairs",
  repetitions: 2,
  seed: 1,
  break_every: 20,
  dates: false,
  staircase: { most_trials: 50 },
  presentation: { device: "mouse" },
  ...changes,
});
const session = (changes: Partial<Session> = {}): Session => ({
  name: "study",
  method: "pairs",
  question: "?",
  object: "",
  participant: "p01",
  device: "mouse",
  trial: 3,
  of: 12,
  answers: 2,
  touching: false,
  ready: false,
  touched: false,
  touched_a: false,
  touched_b: false,
  may_answer: false,
  may_take_back: false,
  ...changes,
});

describe("a study that is set up", () => {
  it("has as many trials as its method asks", () => {
    expect(trialsOf(study())).toBe(12); // both orders of three pairs, twice
    expect(trialsOf(study({ stimuli: [] }))).toBe(0);
    expect(trialsOf(study({ method: "rating" }))).toBe(6);
    expect(trialWords(study({ method: "staircase" }))).toBe("at most 300 trials");
    expect(trialWords(study({ method: "rating", stimuli: ["a.png"], repetitions: 1 }))).toBe("1 trial");
  });

  it("says what it lacks", () => {
    expect(lackOf(study({ stimuli: ["a.png"] }), "p01")).toMatch(/two textures/);
    expect(lackOf(study({ method: "rating", stimuli: [] }), "p01")).toMatch(/a texture/);
    expect(lackOf(study(), "")).toMatch(/code/);
    expect(lackOf(study(), "p01")).toBe("");
  });

  it("takes codes and names that can be part of a file's", () => {
    expect(["p01", "A-b_2"].every(isCode)).toBe(true);
    expect(["", "a b", "é", "../x", "a".repeat(41)].some(isCode)).toBe(false);
    expect(isStudyName("a".repeat(60))).toBe(true);
  });

  it("lists textures in the order in which they were chosen", () => {
    expect(toggled(["a"], "b")).toEqual(["a", "b"]);
    expect(toggled(["a", "b"], "a")).toEqual(["b"]);
    expect(["x/wood.texture.json", "tile.png"].map(stimulusName)).toEqual(["x/wood", "tile"]);
  });
});

describe("a session", () => {
  it("is answered by keys", () => {
    expect(["1", "2", "ArrowLeft", "ArrowRight", "3"].map((key) => answerOfKey("pairs", key))).toEqual([0, 1, 0, 1, null]);
    expect(["1", "7", "8", "ArrowLeft"].map((key) => answerOfKey("rating", key))).toEqual([1, 7, null, null]);
  });

  it("tells how far it is", () => {
    expect(progressWords(session())).toBe("Trial 3 of 12");
    expect(progressWords(session({ of: null }))).toBe("Trial 3");
    expect(progressWords(session({ trial: null }))).toBe("2 answers");
  });

  it("says what is to be done", () => {
    expect(adviceOf(session(), false)).toBe("Press Space to touch.");
    expect(adviceOf(session({ touching: true }), true)).toMatch(/until the textures are ready/);
    expect(adviceOf(session({ touching: true }), false)).toMatch(/does not have the force/);
    expect(adviceOf(session({ touching: true, ready: true, touched: true }), false)).toBe("Touch both: press on A and on B.");
    expect(adviceOf(session({ touching: true, ready: true, touched: true, touched_a: true }), false)).toBe("Now press on B, right.");
    expect(adviceOf(session({ touching: true, ready: true, touched: true, touched_a: true, touched_b: true, may_answer: true }), false)).toMatch(/answer with 1 or 2/);
    expect(adviceOf(session({ touched: true, may_answer: true, method: "rating" }), false)).toMatch(/again, or answer with 1 to 7/);
  });

  it("has no force between two trials, and says so", () => {
    const status = { state: "running", held: true, may_command_forces: true } as FeelStatus;
    expect(forceWords(status, null, true, true).word).toBe("between trials");
  });
});

describe("results", () => {
  it("have thresholds whose error is a factor", () => {
    expect(thresholdWords({ threshold: 0.5, error_ln: Math.log(2), at_limit: false })).toBe("0.500 (0.250 to 1.00)");
    expect(thresholdWords({ threshold: 0.5, error_ln: null, at_limit: false })).toBe("0.500");
    expect(thresholdWords({ threshold: null, error_ln: null, at_limit: false })).toBe("–");
    expect(thresholdWords({ threshold: null, error_ln: null, at_limit: true })).toBe("none: at a limit");
  });

  it("have shares with their interval", () => {
    expect(shareWords({ count: 1, trials: 2, share: 0.5, low: 0.095, high: 0.905 })).toBe("50.0\u202f% (9.50 to 90.5)");
    expect(shareWords({ count: 0, trials: 0, share: null, low: 0, high: 1 })).toBe("–");
  });

  it("show a track with its reversals and threshold", () => {
    const track = { stimulus: 0, repetition: 1, levels: [1, 1, 0.5, 0.7], correct: [true, true, false, true], reversals: [2], done: false, threshold: 0.6, error_ln: 0.1, pairs: 1, at_limit: false };
    const [level, reversals, threshold] = trackSeries(track);
    expect(level!.x).toEqual([1, 2, 3, 4]);
    expect([reversals!.x, reversals!.y]).toEqual([[3], [0.5]]);
    expect(threshold!.lo![0]).toBeCloseTo(0.6 * Math.exp(-0.1), 12);
    expect(trackSeries({ ...track, threshold: null })).toHaveLength(2);
  });
});

test("the page has an address, and opens no file by itself", () => {
  expect(routeOf("#/study").key).toBe("u");
  expect(editToOpen("study", "a.study.json", {})).toBeNull();
});
