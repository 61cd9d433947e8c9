import { describe, expect, it } from "vitest";
import { Pace } from "../src/plot/pace";

/** Pictures in a second of frames that come every `frame_ms`, after two seconds of them. */
function drawn(pace: Pace, frame_ms: number): number {
  let count = 0;
  for (let now_ms = 0; now_ms < 3000; now_ms += frame_ms) {
    if (!pace.due(now_ms)) continue;
    pace.drew(now_ms);
    if (now_ms >= 2000) ++count;
  }
  return count;
}

describe("the pace of pictures", () => {
  it("is the wanted one where frames come quickly", () => {
    expect(drawn(new Pace(45), 15)).toBeGreaterThan(20);
    expect(drawn(new Pace(15), 16)).toBeGreaterThan(55);
  });

  it("leaves more and more frames out where they come slowly", () => {
    expect(drawn(new Pace(15), 40)).toBeLessThan(6);
    expect(drawn(new Pace(15), 100)).toBeLessThanOrEqual(1);
  });
});
