import { describe, expect, it } from "vitest";
import { Ease } from "../src/view3d/ease";

/** The share of two seconds that goes into pictures that cost so much, when a frame comes each 16 ms. */
function busy(cost_ms: number): number {
  const ease = new Ease();
  let spent_ms = 0;
  for (let now_ms = 0; now_ms < 2000; now_ms += 16) {
    if (!ease.due(now_ms)) continue;
    ease.drew(now_ms, now_ms + cost_ms);
    spent_ms += cost_ms;
    now_ms += cost_ms;
  }
  return spent_ms / 2000;
}

describe("pictures that are dear", () => {
  it("leave half of the time to the rest", () => {
    for (const cost_ms of [50, 120, 250]) expect(busy(cost_ms)).toBeLessThan(0.62);
  });

  it("and cheap ones are drawn at each frame", () => {
    const ease = new Ease();
    for (let now_ms = 0; now_ms < 500; now_ms += 16) {
      expect(ease.due(now_ms)).toBe(true);
      ease.drew(now_ms, now_ms + 5);
    }
  });

  it("never make a page wait longer than a second", () => {
    const ease = new Ease();
    ease.drew(0, 60_000);
    expect(ease.due(60_500)).toBe(false);
    expect(ease.due(61_000)).toBe(true);
    ease.drew(100, 50);
    expect(ease.due(50)).toBe(true);
  });
});
