import { describe, expect, it } from "vitest";
import type { Block } from "../src/net/block";
import { powerLine } from "../src/measured/ComplianceScatter";
import { band, configRows, figureGroups, figureValue, measuredOf, positivePoints, profileX_mm, sortedByX, spectrumPoints, thinnedWords } from "../src/measured/measured";
import { repeatedRows } from "../src/measured/repeated";
import { colourAt, colourRange, pathColours } from "../src/measured/pathColours";

const block = (head: object, arrays: Block["arrays"] = {}): Block => ({
  kind: "measured",
  head: {
    result: { recording: "a", object: "board", trustworthy: true, verdict: "", asperity: "1", method: "fused", config: { a: 1 } },
    figures: [],
    dropped: [],
    gaps: [],
    profile: { samples: 3, every: 1, points: 3, first_m: 0.001, spacing_m: 0.0005 },
    ...head,
  },
  arrays,
  shapes: {},
});

describe("a measured block", () => {
  it("gives its parts by name, and nothing for an array that is not there", () => {
    const measured = measuredOf(block({}, { profile_height_m: Float32Array.of(1, 2, 3) }));
    expect(measured.name).toBe("a");
    expect(Array.from(measured.array("profile_height_m"))).toEqual([1, 2, 3]);
    expect(measured.array("compared_s_m").length).toBe(0);
    expect(Array.from(profileX_mm(measured))).toEqual([1, 1.5, 2]);
    expect(measured.segments).toEqual([]);
  });

  it("is no other block", () => {
    expect(() => measuredOf({ ...block({}), kind: "scene" })).toThrow("scene");
  });
});

describe("bands", () => {
  it("lie k sigma round the value", () => {
    const around = band([1, 2], [0.5, 0.25], 2)!;
    expect(Array.from(around.lo)).toEqual([0, 1.5]);
    expect(Array.from(around.hi)).toEqual([2, 2.5]);
  });

  it("are not there where no sigma is known", () => {
    expect(band([1, 2], [NaN, NaN], 2)).toBeNull();
    expect(band([1, 2], [], 2)).toBeNull();
    expect(band([1, 2], [NaN, 1], 2)!.lo[0]).toBeNaN();
  });
});

it("figures keep their order within their groups", () => {
  const figure = (group: string, label: string) => ({ group, key: "", label, value: 1, unit: "" });
  const groups = figureGroups([figure("A", "1"), figure("B", "2"), figure("A", "3")]);
  expect(groups.map(({ name, figures }) => [name, ...figures.map(({ label }) => label)])).toEqual([["A", "1", "3"], ["B", "2"]]);
});

it("counts have no decimals", () => {
  const figure = { group: "A", key: "", label: "Gaps", value: 1, unit: "" };
  expect(figureValue({ ...figure, count: true })).toBe("1");
  expect(figureValue(figure)).toBe(1);
});

it("a config's leaves have dotted paths", () => {
  expect(configRows({ method: "fused", base: { contact: { touch_N: 0.15 }, axis: [0, 1] } })).toEqual([
    { path: "method", value: '"fused"' },
    { path: "base.contact.touch_N", value: "0.15" },
    { path: "base.axis", value: "[0,1]" },
  ]);
});

it("logarithmic axes get positive points only", () => {
  const { x, y } = positivePoints([0, 1, 2, 3], [5, 0, 7, NaN]);
  expect([Array.from(x), Array.from(y)]).toEqual([[2], [7]]);
});

it("a spectrum is drawn with its interval where there is one", () => {
  const known = spectrumPoints([0, 1, 2, 3], [5, 4, 0, 2], [3, 2, 0, 1], [9, 8, 6, 0]);
  expect([known.x, known.y, known.lo!, known.hi!].map((values) => Array.from(values))).toEqual([[1, 2], [4, 2], [2, 2], [8, 6]]);
  const unknown = spectrumPoints([1, 2], [3, 0], [NaN, NaN], [NaN, NaN]);
  expect(Array.from(unknown.x)).toEqual([1]);
  expect(unknown.lo).toBeNull();
});

it("points are sorted by x", () => {
  const { x, y } = sortedByX([3, 1, 2], [30, 10, 20]);
  expect([Array.from(x), Array.from(y)]).toEqual([[1, 2, 3], [10, 20, 30]]);
});

it("says what was left out", () => {
  expect(thinnedWords({ samples: 10, every: 1 }, "samples")).toBe("");
  expect(thinnedWords({ samples: 12345, every: 3 }, "samples")).toBe("One of every 3 of 12\u202f345 samples is shown.");
});

describe("the power of the force", () => {
  it("goes through points that follow one", () => {
    const force = Float64Array.of(0.5, 1, 2);
    const line = powerLine(force, force.map((F) => 0.8 * F ** 0.5), 0.5);
    line.x.forEach((F, i) => expect(line.y[i]).toBeCloseTo(0.8 * F ** 0.5, 12));
    expect([line.x[0], line.x[19]]).toEqual([0.5, 2]);
  });
});

describe("colours along a path", () => {
  it("range over all but a hundredth at either end", () => {
    const values = Float64Array.from({ length: 1001 }, (_, i) => i);
    values[500] = 1e9;
    const range = colourRange(values)!;
    expect(range.low).toBeCloseTo(10, 0);
    expect(range.high).toBeCloseTo(990, -1);
    expect(colourRange([NaN])).toBeNull();
    expect(colourRange([2, 2])).toEqual({ low: 1.5, high: 2.5 });
  });

  it("grow brighter with the value", () => {
    const bright = (share: number) => {
      const [r, g, b] = colourAt(share);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    for (let i = 0; i < 20; ++i) expect(bright((i + 1) / 20)).toBeGreaterThan(bright(i / 20));
  });

  it("are grey where there is no value, and end at the range", () => {
    const colours = pathColours([NaN, -5, 99], { low: 0, high: 1 });
    expect(Array.from(colours.subarray(0, 3))).toEqual([0.5, 0.5, 0.5]);
    expect(Array.from(colours.subarray(6))).toEqual(Array.from(Float32Array.from(colourAt(1))));
  });
});

describe("the table of repeated scans", () => {
  const scan = { name: "a", correlation: 1, rms_um: 0, shift_m: 0, pitch_m: 0.0025, depth_m: null };
  const figure = { group: "", key: "pitch_m", label: "", value: 2.5006, error: 0.0019, unit: "mm" };

  it("ends with the mean and its deviation", () => {
    const rows = repeatedRows([scan, { ...scan, name: "b", correlation: 0.9581, rms_um: 140.2, shift_m: 5.3e-5 }], [figure]);
    expect(rows.map(({ name, correlation, shift_mm, pitch_mm }) => [name, correlation, shift_mm, pitch_mm.replaceAll("\u202f", " ")])).toEqual([
      ["a", "–", "–", "2.500"],
      ["b", "0.9581", "0.0530", "2.500"],
      ["Mean ± sd", "–", "–", "2.5006 ± 0.0019"],
    ]);
    expect(rows[0]!.depth_um).toBe("–");
  });
});
