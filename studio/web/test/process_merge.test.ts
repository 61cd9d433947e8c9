import { describe, expect, it } from "vitest";
import type { Block } from "../src/net/block";
import { agreementWords, gainWords, mergeFigures, mergeKey, mergeOf, ratioWords, strokeChoices, strokeHeights_um, withStroke, type MergedStroke } from "../src/pages/process/merging";
import type { ProcessSection } from "../src/pages/process/processing";

const section = (strokes?: string[]): ProcessSection => ({ scans: [], current: 0, config: {}, ...(strokes ? { merge: { strokes, config: {} } } : {}) });

describe("the strokes of a merge", () => {
  it("are kept in the order in which they were chosen, also in a document that had none", () => {
    const two = withStroke(withStroke(section(), "b", true), "a", true);
    expect(mergeOf(two).strokes).toEqual(["b", "a"]);
    expect(mergeOf(withStroke(two, "b", true)).strokes).toEqual(["a", "b"]);
    expect(mergeOf(withStroke(two, "b", false)).strokes).toEqual(["a"]);
  });

  it("are recordings and results, and what was chosen and is gone", () => {
    const entries = [
      { kind: "recording" as const, name: "a" },
      { kind: "mesh" as const, name: "m.obj" },
      { kind: "result" as const, name: "out" },
    ];
    expect(strokeChoices(entries, ["a", "lost"])).toEqual([
      { name: "a", kind: "recording" },
      { name: "out", kind: "result" },
      { name: "lost", kind: "missing" },
    ]);
  });

  it("make another merge with other strokes or settings alone", () => {
    expect(mergeKey(section(["a"]))).toBe(mergeKey({ ...section(["a"]), current: 3 }));
    expect(mergeKey(section(["a"]))).not.toBe(mergeKey(section(["b"])));
    expect(mergeKey(section(["a"]))).not.toBe(mergeKey({ ...section(["a"]), config: { method: "raw" } }));
  });
});

describe("a merge", () => {
  const block = {
    kind: "measured",
    head: { result: { passes: [{}, {}] } },
    arrays: { profile_texture_m: Float32Array.of(1e-6, 2e-6), stroke_texture_m: Float32Array.of(2e-6, 4e-6, NaN, 1e-6) },
    shapes: {},
  } as unknown as Block;

  it("has each stroke's heights at its points, or their difference from it", () => {
    const [first, second] = strokeHeights_um(block, false);
    expect(first![1]).toBeCloseTo(4, 5);
    expect(second![0]).toBeNaN();
    const [apart] = strokeHeights_um(block, true);
    expect(apart![0]).toBeCloseTo(1, 5);
    expect(apart![1]).toBeCloseTo(2, 5);
  });

  it("has no figures of a motion", () => {
    const figures = [{ group: "Scan", key: "length_m" }, { group: "Scan", key: "profile.length_m" }, { group: "Stiffness", key: "x" }];
    expect(mergeFigures(figures).map(({ key }) => key)).toEqual(["profile.length_m"]);
  });

  it("says what it gains beside what equal strokes could", () => {
    expect(gainWords({ stroke_noise_rms_m: 4e-6, merged_noise_rms_m: 2e-6, share: 0.5 }, 4)).toContain("0.50 of one stroke's noise (0.50 for 4 equal strokes");
    expect(gainWords({ stroke_noise_rms_m: null, merged_noise_rms_m: null, share: null }, 2)).toContain("not known");
  });

  it("has words for the noise and for each stroke's agreement", () => {
    expect(ratioWords({ noise_ratio: null, noise_ratio_low: null, noise_ratio_high: null })).toBeNull();
    expect(ratioWords({ noise_ratio: 1.25, noise_ratio_low: 0.9, noise_ratio_high: 1.8 })).toContain("1.3 times");
    expect(agreementWords({ score: 0, threshold: 0 } as MergedStroke)).toBe("reference");
    expect(agreementWords({ score: 3.14159, threshold: 4.5 } as MergedStroke)).toBe("3.14 (≥ 4.5)");
  });
});
