import { describe, expect, it } from "vitest";
import type { Block } from "../src/net/block";
import { mainLine, noIterations, seriesOf, withBlock } from "../src/pages/align/iterations";
import { latest } from "../src/pages/align/latest";
import { missingWords } from "../src/pages/align/missing";
import { openingKey } from "../src/pages/align/openingKey";
import { nearestOnScreen, pointWords } from "../src/pages/align/picks";
import { verdictWords } from "../src/pages/align/verdict";
import { colourLimit_m, histogram, rampColour, residualColours } from "../src/pages/align/residuals";

const phases = ["search", "annealing", "fit", "restarts", "comparison", "guesses", "refinement"];

function block(run: number, first: number, rms_m: number[], phase: number[], start: number[]): Block {
  const count = rms_m.length;
  return {
    kind: "align.iteration",
    head: { run, first, phases },
    shapes: {},
    arrays: {
      T_mesh_world: Float64Array.from({ length: 7 * count }, (_, index) => first + Math.floor(index / 7)),
      rms_m: Float64Array.from(rms_m),
      phase: Uint8Array.from(phase),
      start: Uint32Array.from(start),
      points: new Uint32Array(count),
      inliers: new Uint32Array(count),
    },
  };
}

it("says what is missing before scan and mesh can be worked on", () => {
  expect(missingWords({ paths: [], mesh: "" }, false, false)).toBe("Choose a scan and a mesh first.");
  expect(missingWords({ paths: [], mesh: "a.obj" }, true, false)).toBe("Choose a scan first.");
  expect(missingWords({ paths: ["scan"], mesh: "" }, true, true)).toBe("Choose a mesh first.");
  expect(missingWords({ paths: ["scan"], mesh: "a.obj" }, true, true)).toMatch(/being opened/);
  expect(missingWords({ paths: ["scan"], mesh: "a.obj" }, false, false)).toMatch(/choose/);
  expect(missingWords({ paths: ["scan"], mesh: "a.obj" }, true, false)).toBe("");
});

describe("what is open", () => {
  const glb = { paths: ["scan"], mesh: "b.glb", mesh_unit: "" };

  it("is another where the page states the project's unit itself", () => {
    expect(openingKey({ ...glb, mesh_unit: "mm" }, "mm")).not.toBe(openingKey(glb, "mm"));
  });

  it("is another in another unit of the project, with other scans and other settings of points", () => {
    const others = [openingKey(glb, "mm"), openingKey(glb, "cm"), openingKey({ ...glb, paths: ["scan", "b"] }, "mm"), openingKey({ ...glb, config: { "points.count": "9" } }, "mm")];
    expect(new Set(others).size).toBe(4);
    expect(openingKey({ ...glb, config: { "search.starts": "9" } }, "mm")).toBe(others[0]);
  });

  it("is nothing without mesh or scans", () => {
    expect([openingKey({}, "mm"), openingKey({ ...glb, mesh: "" }, "mm"), openingKey({ ...glb, paths: [] }, "mm")]).toEqual(["", "", ""]);
  });
});

describe("iterations", () => {
  const one = withBlock(noIterations, block(1, 0, [4e-3, 2e-3], [1, 1], [0, 0]));
  const two = withBlock(one, block(1, 2, [1e-3, 3e-3, 5e-4], [2, 3, 6], [0, 4, 0]));

  it("go on within a run, and begin anew with another", () => {
    expect(two.rms_m).toEqual([4e-3, 2e-3, 1e-3, 3e-3, 5e-4]);
    expect(two.poses.map((pose) => pose[0])).toEqual([0, 1, 2, 3, 4]);
    expect(withBlock(two, block(1, 2, [9e-3], [2], [0])).rms_m).toEqual([4e-3, 2e-3, 9e-3]);
    expect(withBlock(two, block(2, 0, [7e-3], [1], [0])).rms_m).toEqual([7e-3]);
  });

  it("are one series a phase, in millimetres, counted from 1", () => {
    const series = seriesOf(two);
    expect(series.map(({ x }) => Array.from(x!))).toEqual([[1, 2], [3], [4], [5]]);
    expect(series[1]!.y[0]).toBeCloseTo(1, 12);
  });

  it("are played from the guess, without other starts", () => {
    expect(mainLine(two)).toEqual([0, 1, 2, 4]);
    expect(mainLine(withBlock(noIterations, block(3, 0, [1, 1], [0, 0], [0, 1])))).toEqual([0, 1]);
  });
});

describe("distances", () => {
  it("have a round limit that most lie below", () => {
    expect(colourLimit_m([...new Array(99).fill(1.4e-3), 1])).toBeCloseTo(1.5e-3, 12);
    expect(colourLimit_m([0, 0])).toBeCloseTo(1e-5, 12);
    expect(colourLimit_m([-5e-4, 5e-4])).toBeCloseTo(5e-4, 12);
  });

  it("are counted on both sides of the mesh", () => {
    const { edges_mm, percent } = histogram([-1e-3, -0.9e-3, 0.1e-3, 5e-3], 1e-3, 4);
    expect(edges_mm).toEqual([-1, -0.5, 0, 0.5, 1]);
    expect(percent).toEqual([50, 0, 25, 25, 25]);
  });

  it("get brighter as they grow, whatever their side", () => {
    const light = (part: number) => rampColour(part).reduce((sum, value, k) => sum + [0.2126, 0.7152, 0.0722][k]! * value, 0);
    for (let part = 0; part < 1; part += 0.05) expect(light(part + 0.05)).toBeGreaterThan(light(part));
    expect(residualColours([-1e-3], 2e-3)).toEqual(residualColours([1e-3], 2e-3));
    expect(rampColour(NaN)).toEqual(rampColour(1));
  });
});

describe("picking", () => {
  it("finds the nearest point in reach", () => {
    const points = [{ x: 0, y: 0 }, null, { x: 10, y: 0 }];
    expect(nearestOnScreen(points, { x: 6, y: 1 }, 14)).toBe(2);
    expect(nearestOnScreen(points, { x: 60, y: 1 }, 14)).toBe(-1);
  });

  it("says where", () => expect(pointWords([0.0123, -0.004, 0])).toBe("12.3, \u22124.0, 0.0\u202fmm"));
});

describe("calls that follow a drag", () => {
  it("go one at a time, of those that wait the newest alone", async () => {
    const begun: number[] = [];
    let end: () => void = () => {};
    let idle = 0;
    const follow = latest(
      (value: number) => {
        begun.push(value);
        return new Promise<void>((resolve) => (end = resolve));
      },
      () => (idle += 1),
    );
    follow(1);
    follow(2);
    follow(3);
    expect(begun).toEqual([1]);
    end();
    await Promise.resolve();
    await Promise.resolve();
    expect(begun).toEqual([1, 3]);
    expect(follow.busy()).toBe(true);
    end();
    await Promise.resolve();
    await Promise.resolve();
    expect(follow.busy()).toBe(false);
    expect(idle).toBe(1);
  });
});

describe("the verdict in few words", () => {
  const found = { converged: true, trustworthy: true, ambiguous: false, rms_m: 2.7e-5, points: 388, outliers: 2, runner_up: null };

  it("says what it rests on", () => expect(verdictWords(found).replaceAll("\u202f", " ")).toBe("386 of 388 points are on the mesh, within 0.027 mm RMS."));

  it("says what to do where it is invalid", () => {
    expect(verdictWords({ ...found, trustworthy: false, ambiguous: true })).toContain("by pairs");
    expect(verdictWords({ ...found, trustworthy: false, converged: false })).toContain("did not converge");
    expect(verdictWords({ ...found, trustworthy: false, outliers: 300 })).toContain("unit");
  });
});
