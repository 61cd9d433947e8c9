import { describe, expect, it, test } from "vitest";
import { NewestWins } from "../src/pages/process/newestWins";
import { currentIndex, cutoffWords, knobs, withConfig, withoutScan, withScan, type ProcessSection } from "../src/pages/process/processing";
import type { ConfigField } from "../src/ui/configFields";

const field = (path: string, type: ConfigField["type"], value: ConfigField["value"]): ConfigField => ({ path, type, value, default: value });
const section = (recordings: string[], current = 0): ProcessSection => ({
  scans: recordings.map((recording) => ({ recording, segment: "" })),
  current,
  config: {},
});

describe("the fields with the document's settings", () => {
  const defaults = [field("method", "choice", "fused"), field("n", "integer", 3), field("x.y", "number", 0.1), field("on", "bool", true), field("v", "numbers", [1, 2])];

  it("have their values, the others the defaults", () => {
    const fields = withConfig(defaults, { method: "thesis", "x.y": "0.25", on: "false", v: "[3,4]" });
    expect(fields.map(({ value }) => value)).toEqual(["thesis", 3, 0.25, false, [3, 4]]);
    expect(fields[0]!.default).toBe("fused");
  });

  it("go back to the defaults, whatever they were when they were asked for", () => {
    expect(withConfig([{ ...defaults[1]!, value: 7 }], {})[0]!.value).toBe(3);
  });
});

describe("the chosen recordings", () => {
  it("grow by one that is then looked at, and only once", () => {
    const two = withScan(section(["a"]), { recording: "b", segment: "" });
    expect(two.scans.length).toBe(2);
    expect(two.current).toBe(1);
    const again = withScan(two, { recording: "a", segment: "" });
    expect(again.scans.length).toBe(2);
    expect(again.current).toBe(0);
  });

  it("keep what is looked at when another is taken out", () => {
    expect(withoutScan(section(["a", "b", "c"], 2), 0)).toMatchObject({ current: 1 });
    expect(withoutScan(section(["a", "b", "c"], 1), 2)).toMatchObject({ current: 1 });
    expect(withoutScan(section(["a", "b"], 1), 1)).toMatchObject({ current: 0 });
    expect(currentIndex(withoutScan(section(["a"]), 0))).toBe(-1);
  });

  it("have an index even if the document's is beyond them", () => {
    expect(currentIndex(section(["a"], 9))).toBe(0);
  });
});

describe("the settings in front", () => {
  it("are those that the method uses", () => {
    expect(knobs("thesis").every(({ path }) => path.startsWith("thesis."))).toBe(true);
    expect(knobs("fused").some(({ path }) => path.startsWith("thesis."))).toBe(false);
    for (const knob of [...knobs("thesis"), ...knobs("fused")]) if (knob.logarithmic) expect(knob.low).toBeGreaterThan(0);
  });
});

describe("one question at a time", () => {
  /** Questions that are answered by hand. */
  function asking(patience_ms: number) {
    let now_ms = 0;
    const asked: string[] = [];
    const heard: string[] = [];
    const answers: (() => void)[] = [];
    const queue = new NewestWins(patience_ms, () => now_ms);
    const ask = (name: string) =>
      queue.ask(async (isNewest) => {
        asked.push(name);
        await new Promise<void>((resolve) => answers.push(resolve));
        if (isNewest()) heard.push(name);
      });
    const settle = () => new Promise((resolve) => setTimeout(resolve));
    return { ask, asked, heard, answer: async () => (answers.shift()!(), await settle()), pass: (ms: number) => (now_ms += ms) };
  }

  it("skips those in between", async () => {
    const { ask, asked, heard, answer } = asking(1000);
    for (const name of ["1", "2", "3", "4"]) ask(name);
    expect(asked).toEqual(["1"]);
    await answer();
    expect(asked).toEqual(["1", "4"]);
    await answer();
    expect(heard).toEqual(["4"]);
  });

  it("does not wait for one that takes long", async () => {
    const { ask, asked, heard, answer, pass } = asking(1000);
    ask("slow");
    pass(1001);
    ask("new");
    expect(asked).toEqual(["slow", "new"]);
    await answer();
    await answer();
    expect(heard).toEqual(["new"]);
  });

  it("goes on after one that failed", async () => {
    const queue = new NewestWins(1000);
    const heard: string[] = [];
    await new Promise<void>((resolve) => {
      queue.ask(async () => {
        heard.push("first");
      });
      queue.ask(async () => {
        heard.push("second");
        resolve();
      });
    });
    expect(heard).toEqual(["first", "second"]);
  });
});

test("the cut-off is stated as a wavelength", () => {
  expect(cutoffWords(0.1).replaceAll("\u202f", " ")).toBe("λc = 10.0 mm: longer waves are not part of the texture.");
  expect(cutoffWords(1.25).replaceAll("\u202f", " ")).toContain("λc = 800 µm");
  expect(cutoffWords(0)).toContain("No high-pass");
});
