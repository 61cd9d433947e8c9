import { describe, expect, it } from "vitest";
import type { Block, NumberArray } from "../src/net/block";
import { band, Column, Growing, RowCounter } from "../src/pages/scan/growing";
import { HostClock, Recent } from "../src/pages/scan/latency";
import { pathColour, strongest_N } from "../src/pages/scan/pathColours";
import { abilities, bodyWords, contactWords, objectHint, discardedWords, isLiveUsable, recordWords, sensorWords, type RecorderState, type ScanState } from "../src/pages/scan/scanState";
import { changed, processSettings, valueOf, waitsForOpening, withSettings } from "../src/pages/scan/settings";

const block = (generation: number, first: number, s: number[], tips?: number[]): Block => {
  const arrays: Record<string, NumberArray> = { s_m: Float64Array.from(s), height_m: Float64Array.from(s, (value) => 2 * value) };
  const shapes: Record<string, number[]> = { s_m: [s.length], height_m: [s.length] };
  if (tips) {
    arrays.tip_m = Float32Array.from(tips);
    shapes.tip_m = [tips.length / 3, 3];
  }
  return { kind: "scan.profile", head: { generation, first }, arrays, shapes };
};

describe("a further marker body", () => {
  it("is in view while its poses are of the last half second", () => {
    const body = { name: "object", rows: 7, markers: 2, pose_age_s: 0.1 };
    expect(bodyWords(body)).toEqual({ lamp: "good", word: "2 markers in view" });
    expect(bodyWords({ ...body, markers: 1 }).word).toBe("1 marker in view");
    expect(bodyWords({ ...body, markers: 0 }).word).toBe("in view");
    expect(bodyWords({ ...body, pose_age_s: 0.6 })).toEqual({ lamp: "bad", word: "not in view" });
    expect(bodyWords({ ...body, markers: null, pose_age_s: null }).lamp).toBe("warn");
  });

  it("called object changes what the page is about", () => {
    const recorder = { bodies: [{ name: "object", rows: 0, markers: null, pose_age_s: null }] } as unknown as RecorderState;
    expect(objectHint(recorder)).toContain("Process page");
    expect(objectHint({ ...recorder, bodies: [{ name: "table", rows: 0, markers: null, pose_age_s: null }] })).toBe("");
    expect(objectHint(undefined)).toBe("");
  });
});

describe("what grows", () => {
  it("appends in the unit that is shown", () => {
    const column = new Column();
    column.append([1, 2], 1000);
    column.append(new Array(2000).fill(3));
    expect(column.length).toBe(2002);
    expect([...column.values.subarray(0, 3)]).toEqual([1000, 2000, 3]);
  });

  it("goes on where the last block ended, begins anew with a generation, and asks for the whole at a gap", () => {
    let asked = 0;
    const grown = new Growing({ s_m: 1e3, height_m: 1 }, "s_m", () => ++asked);
    grown.take(block(1, 0, [0, 1]));
    grown.take(block(1, 2, [2]));
    expect([...grown.columns.s_m.values]).toEqual([0, 1000, 2000]);
    expect([...grown.columns.height_m.values]).toEqual([0, 2, 4]);
    grown.take(block(1, 5, [9]));
    expect(asked).toBe(1);
    expect(grown.length).toBe(3);
    grown.take(block(2, 1, [9]));
    expect(asked).toBe(2);
    grown.take(block(2, 0, [7]));
    expect([...grown.columns.s_m.values]).toEqual([7000]);
  });

  it("takes only what is new of a block that overlaps", () => {
    const grown = new Growing({ s_m: 1, tip_m: 1 }, "tip_m", () => undefined, 3);
    grown.take(block(1, 0, [0, 1], [0, 0, 0, 1, 1, 1]));
    grown.take(block(1, 1, [1, 2], [1, 1, 1, 2, 2, 2]));
    expect([...grown.columns.s_m.values]).toEqual([0, 1, 2]);
    expect([...grown.columns.tip_m.values]).toEqual([0, 0, 0, 1, 1, 1, 2, 2, 2]);
  });

  it("counts rows that never came", () => {
    const rows = new RowCounter();
    rows.take(100, 10);
    rows.take(110, 5);
    rows.take(120, 5);
    expect([rows.rows, rows.lost]).toEqual([20, 5]);
    rows.take(0, 3);
    expect([rows.rows, rows.lost]).toEqual([3, 0]);
  });

  it("lays a band round the heights", () => {
    const { lo, hi } = band(Float64Array.of(1, NaN), Float64Array.of(0.5, 1));
    expect([lo[0], hi[0]]).toEqual([0.5, 1.5]);
    expect(lo[1]).toBeNaN();
  });
});

describe("latency", () => {
  it("trusts the quickest ping", () => {
    const clock = new HostClock();
    expect(clock.known).toBe(false);
    clock.add(0, 5_000_000_000, 100); // the host's 5000 ms fell anywhere in 100 ms
    clock.add(200, 5_191_000_000, 202); // here within 2 ms
    expect(clock.toHere_ms(5_191_000_000)).toBeCloseTo(201, 9);
    expect(clock.doubt_ms).toBe(1);
  });

  it("knows the median and the tail of the newest values", () => {
    const recent = new Recent(5);
    expect(recent.quantile(0.5)).toBeNaN();
    for (const value of [100, 1, 2, 3, 4, 50]) recent.add(value);
    expect(recent.quantile(0.5)).toBe(3);
    expect(recent.quantile(0.95)).toBe(50);
  });
});

describe("colours of the path", () => {
  it("are grey in the air and go from blue to red with the force", () => {
    for (const dark of [true, false]) {
      const [r, g, b] = pathColour(2, 0, dark);
      expect(Math.max(r, g, b) - Math.min(r, g, b)).toBeLessThan(0.1);
      expect(pathColour(0, 1, dark)[2]).toBeGreaterThan(pathColour(0, 1, dark)[0]);
      expect(pathColour(strongest_N, 1, dark)[0]).toBeGreaterThan(pathColour(strongest_N, 1, dark)[2]);
      expect(pathColour(99, 1, dark)).toEqual(pathColour(strongest_N, 1, dark));
      expect(pathColour(NaN, 1, dark)).toEqual(pathColour(0, 1, dark));
    }
  });
});

const recorder = (changes: Partial<RecorderState>): RecorderState =>
  ({ storing: false, automatic: false, segments: [], failure: "", touching: false, contact_ready: true, segment: "", ...changes }) as RecorderState;
const open = (changes: Partial<RecorderState>, source: object = {}): ScanState =>
  ({ open: true, recorder: recorder(changes), source: { plays: false, playing: true, ...source } }) as ScanState;
const done = { name: "segment_1", duration_s: 1, open: false };

describe("the recorder's state", () => {
  it("is said in words", () => {
    expect(recordWords(null).word).toBe("…");
    expect(recordWords({ open: false }).word).toBe("No source open");
    expect(recordWords({ open: false, opening: true }).word).toBe("Opening …");
    expect(recordWords(open({})).word).toBe("Ready");
    expect(recordWords(open({ automatic: true })).word).toBe("Waiting for contact");
    expect(recordWords(open({ storing: true, segment: "rim" })).word).toBe("Recording");
    expect(recordWords(open({ storing: true, failure: "full" })).lamp).toBe("bad");
    expect(contactWords(recorder({ touching: true })).word).toBe("in contact");
    expect(contactWords(recorder({ contact_ready: false })).lamp).toBe("busy");
    expect(sensorWords({ state: "running" } as never, true).word).toBe("waiting for Start");
    expect(sensorWords({ state: "lost" } as never, true).lamp).toBe("bad");
  });

  it("says what was discarded", () => {
    expect(discardedWords(null)).toBe("");
    expect(discardedWords(open({ discarded: 0, last_discarded: null }))).toBe("");
    const last = { name: "rim", duration_s: 3.21 };
    expect(discardedWords(open({ discarded: 1, last_discarded: last }))).toContain("rim (3.2\u202fs) discarded");
    expect(discardedWords(open({ discarded: 3, last_discarded: last }))).toContain("and 2 more");
    expect(discardedWords({ ...open({ discarded: 1, last_discarded: last }), open: false })).toBe("");
  });

  it("knows which live profile is of use", () => {
    expect([isLiveUsable(null), isLiveUsable({ correlation: null }), isLiveUsable({ correlation: 0.9 })]).toEqual([false, false, true]);
  });

  it("allows what makes sense", () => {
    expect(abilities({ open: false })).toEqual({ start: false, stop: false, segment: false, discard: false, rescan: false, restore: false });
    expect(abilities(open({ last_discarded: { name: "rim", duration_s: 3 } })).restore).toBe(true);
    expect(abilities(open({}))).toMatchObject({ start: true, stop: false, discard: false });
    expect(abilities(open({ storing: true, segments: [{ ...done, open: true }] }))).toEqual({ start: false, stop: true, segment: true, discard: true, rescan: true, restore: false });
    expect(abilities(open({ automatic: true, segments: [done] }))).toMatchObject({ start: false, stop: false, segment: false, discard: true, rescan: false });
    expect(abilities(open({ automatic: true }, { plays: true, playing: false }))).toMatchObject({ start: true, stop: false });
    expect(abilities(open({ storing: true }, { plays: true }))).toMatchObject({ segment: false, stop: true });
  });
});

describe("settings", () => {
  it("are TOML's texts, read as values", () => {
    expect(valueOf("0.25")).toBe(0.25);
    expect(valueOf("true")).toBe(true);
    expect(valueOf("[1, 2]")).toEqual([1, 2]);
    expect(valueOf("thesis")).toBe("thesis");
    expect(valueOf('"thesis"')).toBe("thesis");
  });

  it("change, and go back to their defaults", () => {
    const fields = [
      { path: "a.x", type: "number" as const, value: 9, default: 1 },
      { path: "a.y", type: "choice" as const, value: "p", default: "p", choices: ["p", "q"] },
    ];
    const settings = changed({ "a.x": "2" }, { "a.y": "q" });
    expect(withSettings(fields, settings).map((field) => field.value)).toEqual([2, "q"]);
    expect(withSettings(fields, changed(settings, { "a.x": null })).map((field) => field.value)).toEqual([1, "q"]);
    expect(processSettings({ "process.profile.x": "1", "bench.seed": "2" })).toEqual({ "profile.x": "1" });
    expect([waitsForOpening("bench.seed"), waitsForOpening("process.method")]).toEqual([true, false]);
  });
});
