import { expect, test } from "vitest";
import { firstCursors, measured, placed, stepped } from "../src/plot/measure";

const x = [0, 1, 2, 3, 4];
const plot = { x, xAxis: { label: "path length", unit: "mm" }, yAxis: { label: "height", unit: "µm" } };

test("the difference of two points of a line is that of the line", () => {
  const words = measured(plot, [{ label: "height", y: x.map((value) => 10 * value - 3) }], { a: 1, b: 4 });
  expect(words).toMatch(/^A 1(\.0+)?\s?mm, B 4(\.0+)?\s?mm: Δx 3(\.0+)?\s?mm, Δz 30(\.0+)?\s?µm$/u);
});

test("cursors in the other order give a negative difference, and each series has its own", () => {
  const words = measured(plot, [{ label: "one", y: x }, { label: "two", y: x.map((value) => -value) }, { label: "three", y: x, hidden: true }], { a: 4, b: 2 });
  expect(words).toMatch(/Δx [−-]2/);
  expect(words).toMatch(/Δz one [−-]2(\.0+)?, two 2/);
  expect(words).not.toMatch(/three/);
});

test("what has no height unit is y", () => {
  expect(measured({ ...plot, yAxis: { label: "force", unit: "N" } }, [{ label: "f", y: x }], { a: 0, b: 1 })).toMatch(/Δy 1/);
});

test("cursors begin within what is shown, a click moves the nearer one, a step stays inside", () => {
  expect(firstCursors({ min: 0, max: 3 }, false)).toEqual({ a: 1, b: 2 });
  expect(firstCursors({ min: 1, max: 1000 }, true).a).toBeCloseTo(10, 9);
  expect(placed({ a: 1, b: 2 }, 1.9)).toEqual({ a: 1, b: 1.9 });
  expect(placed({ a: 1, b: 2 }, 0)).toEqual({ a: 0, b: 2 });
  expect(stepped({ a: 0, b: 2 }, "a", -1, { min: 0, max: 4 })).toEqual({ a: 0, b: 2 });
  expect(stepped({ a: 0, b: 2 }, "b", 1, { min: 0, max: 4 }).b).toBeCloseTo(2.02, 12);
});
