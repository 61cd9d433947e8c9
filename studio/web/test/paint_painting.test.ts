import { describe, expect, it } from "vitest";
import { chequer_mm, indexOf, kWarpLimit, type Stroke, warpPart, warpWords } from "../src/pages/paint/painting";

const stroke = (texture: string, index: number): Stroke => ({ picks_m: [], texture, index });

describe("indexOf", () => {
  it("gives a texture the number that it has", () => {
    expect(indexOf("a", [stroke("b", 1), stroke("a", 4)], [])).toBe(4);
  });
  it("gives a new one the next that neither strokes nor scene have", () => {
    expect(indexOf("c", [stroke("b", 1)], [{ index: 7, file: "x", name: "" }])).toBe(8);
    expect(indexOf("c", [], [])).toBe(1);
  });
});

describe("warp", () => {
  it("is nothing where lengths are kept, and whole at the limit and beyond", () => {
    expect(warpPart(1)).toBe(0);
    expect(warpPart(kWarpLimit)).toBeCloseTo(1);
    expect(warpPart(-kWarpLimit)).toBeCloseTo(-1);
    expect(warpPart(-9)).toBe(-1);
    expect(warpPart(NaN)).toBe(0);
  });
  it("gives equal ratios equal parts", () => {
    expect(warpPart(Math.sqrt(kWarpLimit))).toBeCloseTo(0.5);
  });
  it("is said in words", () => {
    expect(warpWords(1)).toBe("length preserved");
    expect(warpWords(1.2)).toBe("1.200 times stretched");
    expect(warpWords(-1.5)).toBe("1.500 times compressed");
    expect(warpWords(NaN)).toBe("folded flat");
  });
});

describe("chequer", () => {
  it("has some twenty squares a path, of a round size", () => {
    expect(chequer_mm(0.03)).toBe(2);
    expect(chequer_mm(0.0001)).toBe(0.1);
    expect(chequer_mm(10)).toBe(50);
  });
});
