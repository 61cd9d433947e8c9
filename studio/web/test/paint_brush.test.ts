import { Vector3 } from "three";
import { expect, test } from "vitest";
import { aim, extended, ring, spacing_m } from "../src/pages/paint/brush";
import type { Point } from "../src/pages/paint/painting";

test("a drag has points as far apart as the half-width, or a hundredth of the mesh", () => {
  expect(spacing_m(6, 0.1)).toBeCloseTo(0.006, 12);
  expect(spacing_m(0, 0.1)).toBeCloseTo(0.001, 12);
  let points: readonly Point[] = [];
  for (let k = 0; k <= 100; ++k) points = extended(points, [k * 1e-4, 0, 0], 0.00295);
  expect(points.map(([x]) => Math.round(x * 1e4))).toEqual([0, 30, 60, 90]);
});

test("the ring is about the normal, with the brush's radius", () => {
  const circle = ring("#000");
  aim(circle, [1, 2, 3], new Vector3(2, 0, 0), 0.5);
  circle.updateMatrix();
  const at = circle.geometry.getAttribute("position");
  for (const index of [0, 17, 40]) {
    const corner = new Vector3().fromBufferAttribute(at, index).applyMatrix4(circle.matrix);
    expect(corner.x).toBeCloseTo(1, 6);
    expect(Math.hypot(corner.y - 2, corner.z - 3)).toBeCloseTo(0.5, 6);
  }
});
