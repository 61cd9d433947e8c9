import { describe, expect, it } from "vitest";
import type { Block } from "../src/net/block";
import { areaFigures, areaKey, holes, mapPixels, mapRange, mapValues_um, patchCorners, type AreaResult } from "../src/pages/align/area";

const block = {
  kind: "align.area",
  head: { map: { columns: 2, rows: 3, every: 1, spacing_m: 1e-3 } },
  arrays: {
    height_m: Float32Array.of(1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6),
    sigma_m: Float32Array.of(1e-7, 1e-7, 2e-7, 2e-7, 9e-6, 9e-6),
    supported: Uint8Array.of(1, 1, 1, 1, 0, 0),
    positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0),
    indices: Uint32Array.of(0, 1, 2, 2, 1, 3),
    triangle: Uint32Array.of(1),
    xy_mm: Float32Array.of(0, 2, 1, 0, 1, 2),
  },
  shapes: {},
} as unknown as Block;

describe("the map", () => {
  it("has no values in holes, and colours for the others alone", () => {
    const values = mapValues_um(block, "height");
    expect(values[3]).toBeCloseTo(4, 5);
    expect(values[4]).toBeNaN();
    const pixels = mapPixels(values, mapRange(values, "height")!);
    expect(Array.from({ length: 6 }, (_, at) => pixels[4 * at + 3])).toEqual([255, 255, 255, 255, 0, 0]);
    expect(holes(block.arrays.supported!)).toBeCloseTo(1 / 3, 12);
  });

  it("shows σ from 0 on, without that of the holes", () => {
    const range = mapRange(mapValues_um(block, "sigma"), "sigma")!;
    expect(range.low).toBe(0);
    expect(range.high).toBeCloseTo(0.2, 5);
    expect(mapRange([NaN], "sigma")).toBeNull();
  });

  it("lies on the triangles by their coordinates, each at the middle of its point", () => {
    const { positions, uv } = patchCorners(block);
    expect(Array.from(positions)).toEqual([0, 1, 0, 1, 0, 0, 1, 1, 0]);
    // Corner at x = 0, y = 2 mm: the left point of the last row, the lowest of the picture.
    expect(uv[0]).toBeCloseTo(0.25, 6);
    expect(uv[1]).toBeCloseTo(1 - 2.5 / 3, 6);
    expect(uv[2]).toBeCloseTo(0.75, 6);
    expect(uv[3]).toBeCloseTo(1 - 0.5 / 3, 6);
  });
});

describe("the area", () => {
  it("is another one for another folder or setting", () => {
    expect(areaKey(undefined)).toBe(areaKey({ folder: "", config: {} }));
    expect(areaKey({ folder: "a", config: {} })).not.toBe(areaKey({ folder: "a", config: { "map.held_out": "4" } }));
  });

  it("has figures with units, and none where nothing is known", () => {
    const result: AreaResult = {
      trustworthy: false, verdict: "", verdicts: [],
      patch: { triangles: 12, filled: 1, area_mm2: 34.5, covered: null, textured_triangles: 0, apart: [] },
      parametrisation: { stretch_min: 0.98, stretch_max: 1.02 },
      map: { columns: 0, rows: 0, spacing_mm: 0, rms_m: 20e-6, sigma_rms_m: null, correlation_mm: 0.5, agreement: 0.7, agreement_sigma: 0.1, ties: 3 },
      held_out: { strokes: 0, error_rms_m: null, error_over_sigma: null },
      scans: [{ name: "a" }, { name: "b" }],
    };
    const figures = new Map(areaFigures(result).map((figure) => [figure.label, figure]));
    expect(figures.get("Height, RMS")!.value).toBeCloseTo(20, 9);
    expect(figures.get("Share with heights")!.value).toBeNull();
    expect(figures.get("Agreement")).toMatchObject({ unit: "%", error: 10 });
    expect(figures.get("Stretch")!.value).toBe("0.980 to 1.020");
    expect(figures.get("Scans")!.value).toBe(2);
  });
});
