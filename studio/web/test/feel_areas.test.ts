import { describe, expect, it } from "vitest";
import { areaOutline, greys, trianglesByTexture, uvOf, type TextureHead } from "../src/pages/feel/feelAreas";
import { causeWords, watchdog, type FeelState } from "../src/pages/feel/feelStore";
import { pointerKey, settingValue } from "../src/pages/feel/feelChoices";
import { WayTrace } from "../src/pages/feel/wayTrace";

const head: TextureHead = {
  name: "wave", kind: "fourier1d", highest_m: 1e-4, x0_m: 0, y0_m: 0, width_m: 0.01, height_m: 0.02, kc: null, stiffness_N_per_m: null, friction: null,
};

describe("textured areas", () => {
  it("are told apart", () => {
    const groups = trianglesByTexture([1, -1, 1, 0], 4);
    expect([...groups.keys()]).toEqual([-1, 0, 1]);
    expect(Array.from(groups.get(1)!)).toEqual([0, 2]);
    expect([...trianglesByTexture(undefined, 3).keys()]).toEqual([-1]);
  });

  it("have picture coordinates by their size", () => {
    const uv = uvOf([0, 0, 0.01, 0, 0, 0.02], Uint32Array.of(0), head);
    expect(Array.from(uv)).toEqual([0, 0, 1, 0, 0, 1]);
    const stripes = uvOf([0, 0, 0.004, 0, 0, 0.004], Uint32Array.of(0), { ...head, width_m: 0, height_m: 0 });
    expect(Array.from(stripes)).toEqual([0, 0, 1, 0, 0, 1]);
  });

  it("end where another begins and where the mesh does", () => {
    // Two triangles of a square, one of them textured.
    const edges = areaOutline([0, 1, 2, 0, 2, 3], [0, -1]);
    const pairs = Array.from({ length: edges.length / 2 }, (_, index) => [edges[2 * index]!, edges[2 * index + 1]!].sort().join("-")).sort();
    expect(pairs).toEqual(["0-1", "0-2", "1-2"]);
    expect(areaOutline([0, 1, 2, 0, 2, 3], [-1, -1]).length).toBe(0);
  });

  it("have heights as greys", () => {
    expect(Array.from(greys([0, 5e-5, 1e-4, 2e-4], 1e-4))).toEqual([0, 128, 255, 255]);
    expect(Array.from(greys([0, 1], 0, 90))).toEqual([90, 90]);
  });
});

describe("the watchdog's word", () => {
  const state = (limited: string[], starts_inside = false) => ({ limited, starts_inside }) as FeelState;
  it("names the gravest cause", () => {
    expect(watchdog(state([]))).toEqual({ lamp: "good", word: "no fault" });
    expect(watchdog(state(["soft-start", "stale"]))).toEqual({ lamp: "bad", word: causeWords("stale") });
    expect(watchdog(state(["not-permitted"])).lamp).toBe("warn");
    expect(watchdog(state(["force-limit"])).word).toBe("at the force limit");
    expect(watchdog(state([], true)).word).toContain("inside");
  });
});

describe("settings", () => {
  it("are kept as the form's text says", () => {
    expect(settingValue("0.25")).toBe(0.25);
    expect(settingValue("true")).toBe(true);
    expect(settingValue("[1,2]")).toEqual([1, 2]);
    expect(settingValue("stochastic")).toBe("stochastic");
    expect(pointerKey("a/b~c")).toBe("a~1b~0c");
  });
});

describe("the trace over the way", () => {
  it("has rows only where the tip has moved, and the newest of them", () => {
    const trace = new WayTrace(3, 0.1);
    trace.append([0, 0.05, 0.1, 0.2], [1, 2, 3, 4]);
    expect(trace.rows()).toEqual({ way_mm: [0, 0.1, 0.2], height_um: [1, 3, 4] });
    trace.append([0.3, 0.4, 0.5, 0.6, 0.7], [5, 6, 7, 8, 9]);
    expect(trace.rows()).toEqual({ way_mm: [0.5, 0.6, 0.7], height_um: [7, 8, 9] });
    trace.clear();
    expect(trace.rows().way_mm).toEqual([]);
  });
});
