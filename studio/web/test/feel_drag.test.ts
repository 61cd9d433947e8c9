import { describe, expect, it } from "vitest";
import { alongSurface, dot, length, onPlane, pointOf, pressDepth, raised, unit, type Point } from "../src/pages/feel/drag";
import { springLine } from "../src/pages/feel/spring";

describe("the drag plane", () => {
  it("is met where the ray meets it", () => {
    const place = onPlane({ origin: [1, 2, 5], direction: [0, 0, -2] }, [0, 0, 1], [0, 0, 1]);
    expect(place).toEqual([1, 2, 1]);
    const slanted = onPlane({ origin: [0, 0, 1], direction: [1, 0, -1] }, [0, 0, 0], [0, 0, 3])!;
    expect(slanted[0]).toBeCloseTo(1, 12);
    expect(slanted[2]).toBeCloseTo(0, 12);
  });

  it("is not met behind the viewer, nor by a ray that grazes it", () => {
    expect(onPlane({ origin: [0, 0, 1], direction: [0, 0, 1] }, [0, 0, 0], [0, 0, 1])).toBeNull();
    expect(onPlane({ origin: [0, 0, 1], direction: [1, 0, -0.01] }, [0, 0, 0], [0, 0, 1])).toBeNull();
    expect(onPlane({ origin: [0, 0, 1], direction: [1, 0, 0] }, [0, 0, 0], [0, 0, 1])).toBeNull();
  });
});

describe("the target", () => {
  it("is over its place by its height, and in it while it presses", () => {
    const normal: Point = [0, 1, 0];
    expect(pointOf({ place: [1, 1, 1], normal, height_m: 0.5 })).toEqual([1, 1.5, 1]);
    expect(pointOf({ place: [1, 1, 1], normal, height_m: -0.25 })).toEqual([1, 0.75, 1]);
  });

  it("stays within its limits", () => {
    const limits = { hover_m: 0.003, deepest_m: 0.01 };
    expect(raised(0, 1, limits)).toBe(0.003);
    expect(raised(0, -1, limits)).toBe(-0.01);
    expect(raised(0.001, -0.002, limits)).toBeCloseTo(-0.001, 12);
  });

  it("is pressed by a pen's pressure, and by a mouse as deep as is set", () => {
    expect(pressDepth(0.004, "mouse", 0.5)).toBe(0.004);
    expect(pressDepth(0.004, "touch", 0.9)).toBe(0.004);
    expect(pressDepth(0.004, "pen", 0.5)).toBeCloseTo(0.004, 12);
    expect(pressDepth(0.004, "pen", 1)).toBeCloseTo(0.008, 12);
  });
});

describe("a direction along the surface", () => {
  it("is what is meant, as far as the surface allows", () => {
    const normal = unit([0, 1, 1])!;
    const along = alongSurface([1, 0, 0], normal, [0, 0, 1]);
    expect(along).toEqual([1, 0, 0]);
    const tilted = alongSurface([0, 1, 0], normal, [1, 0, 0]);
    expect(length(tilted)).toBeCloseTo(1, 12);
    expect(dot(tilted, normal)).toBeCloseTo(0, 12);
    expect(tilted[1]).toBeGreaterThan(0);
  });

  it("falls back where what is meant points straight off it", () => {
    const along = alongSurface([0, 0, 1], [0, 0, 1], [0, 1, 0]);
    expect(along).toEqual([0, 1, 0]);
    const none = alongSurface([0, 0, 1], [0, 0, 1], [0, 0, 2]);
    expect(dot(none, [0, 0, 1])).toBeCloseTo(0, 12);
    expect(length(none)).toBeCloseTo(1, 12);
  });
});

describe("a spring", () => {
  it("goes from end to end, no wider than it is", () => {
    const line = springLine([0, 0, 0], [0, 0, 1], 0.1, 5);
    expect(line.length).toBe(3 * 23);
    expect(Array.from(line.slice(0, 3))).toEqual([0, 0, 0]);
    expect(Array.from(line.slice(-3))).toEqual([0, 0, 1]);
    for (let index = 0; index < line.length; index += 3) expect(Math.hypot(line[index]!, line[index + 1]!)).toBeLessThan(0.1001);
  });

  it("has no size between two points that are one", () => {
    expect(springLine([1, 2, 3], [1, 2, 3], 0.1, 3).every(Number.isFinite)).toBe(true);
  });
});
