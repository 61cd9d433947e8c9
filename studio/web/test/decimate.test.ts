import { expect, test } from "vitest";
import { decimate, lowerBound } from "../src/plot/decimate";
import { LiveBuffer } from "../src/plot/LiveBuffer";
import { columnsBetween, extent, nearest } from "../src/plot/series";
import { tickWords } from "../src/plot/options";
import { zoomed } from "../src/plot/zoom";

/** The same numbers each time, from −1 to 1. */
function noise(count: number): Float64Array {
  let state = 12345;
  return Float64Array.from({ length: count }, () => {
    state = (1103515245 * state + 12345) % 2147483648;
    return state / 1073741824 - 1;
  });
}
const ramp = (count: number, step = 1) => Float64Array.from({ length: count }, (_, index) => index * step);

test("no peak is lost, and points stay in order", () => {
  const y = noise(10000);
  y[4321] = 77;
  y[8765] = -55;
  const few = decimate(ramp(10000), [y], 0, 10000, 100);
  expect(few.x.length).toBe(200);
  expect(Math.max(...few.ys[0]!)).toBe(77);
  expect(Math.min(...few.ys[0]!)).toBe(-55);
  expect([...few.x]).toEqual([...few.x].sort((a, b) => a - b));
  for (let bucket = 0; bucket < 100; ++bucket) {
    const part = [...y.slice(100 * bucket, 100 * bucket + 100)];
    expect([...few.ys[0]!.slice(2 * bucket, 2 * bucket + 2)].sort((a, b) => a - b)).toEqual([Math.min(...part), Math.max(...part)]);
  }
});

test("what fits is copied as it is", () => {
  const few = decimate(ramp(50), [ramp(50, 2)], 10, 20, 100);
  expect([...few.x]).toEqual([10, 11, 12, 13, 14, 15, 16, 17, 18, 19]);
  expect([...few.ys[0]!]).toEqual([20, 22, 24, 26, 28, 30, 32, 34, 36, 38]);
});

test("the edges of a band keep their own side", () => {
  const y = noise(1000);
  const few = decimate(ramp(1000), [y, y], 0, 1000, 10, ["low", "high"]);
  const part = [...y.slice(0, 100)];
  expect([...few.ys[0]!.slice(0, 2)]).toEqual([Math.min(...part), Math.min(...part)]);
  expect([...few.ys[1]!.slice(0, 2)]).toEqual([Math.max(...part), Math.max(...part)]);
});

test("holes stay holes", () => {
  const y = noise(1000).fill(NaN, 200, 400);
  const { data } = columnsBetween(ramp(1000), [{ label: "y", y }], 0, 999, 10);
  expect(data[1]!.slice(4, 8)).toEqual([null, null, null, null]);
  expect(data[1]!.slice(0, 4)).not.toContain(null);
});

test("series with an x of their own are merged in order, each in its column", () => {
  const series = [
    { label: "a", y: [1, 2] },
    { label: "b", x: [0.5, 3], y: [5, 6], lo: [4, 5], hi: [6, 7] },
  ];
  const { data, at } = columnsBetween([0, 1], series, 0, 3, 100);
  expect(at).toEqual([1, 4]);
  expect([...data[0]!]).toEqual([0, 0.5, 1, 3]);
  expect(data[1]).toEqual([1, undefined, 2, undefined]);
  expect(data[4]).toEqual([undefined, 5, undefined, 6]);
  expect(extent([0, 1], series)).toEqual([0, 3]);
  expect(extent([], [{ label: "c", y: [] }])).toBeNull();
});

test("lowerBound is the first that is not smaller", () => {
  expect([0, 1, 1.5, 4, 9].map((value) => lowerBound([1, 2, 4], value))).toEqual([0, 0, 1, 2, 3]);
});

test("nearest is the nearer neighbour", () => {
  expect([0, 1.4, 1.6, 9].map((value) => nearest([1, 2, 4], value))).toEqual([0, 0, 1, 2]);
  expect(nearest([], 1)).toBe(-1);
});

test("a live buffer keeps the newest and shows its peaks", () => {
  const buffer = new LiveBuffer(1, 1000);
  for (let at = 0; at < 3000; at += 100) {
    const t = Float64Array.from({ length: 100 }, (_, index) => (at + index) * 1e-3);
    buffer.append(t, [t.map((value) => (Math.abs(value - 2.7) < 1e-9 ? 50 : Math.sin(value)))]);
  }
  expect(buffer.length).toBe(1000);
  expect(buffer.newest_s).toBeCloseTo(2.999, 9);
  const x = new Float64Array(100);
  const y = new Float64Array(100);
  const count = buffer.recent(0.5, x, [y]);
  expect(count).toBeGreaterThan(80);
  expect(x[0]).toBeGreaterThan(2.47);
  expect(x[count - 1]).toBeCloseTo(2.999, 9);
  expect(Math.max(...y.subarray(0, count))).toBe(50);
  buffer.append([0.1], [[7]]);
  expect(buffer.length).toBe(1);
  expect(buffer.newest(0)).toBe(7);
});

test("a chunk larger than the ring leaves its end", () => {
  const buffer = new LiveBuffer(1, 10);
  buffer.append(ramp(25), [ramp(25)]);
  expect(buffer.length).toBe(10);
  const x = new Float64Array(100);
  expect(buffer.recent(100, x, [new Float64Array(100)])).toBeGreaterThan(0);
  expect(x[0]).toBe(15);
});

test("ticks have the decimals of their step", () => {
  expect(tickWords([-0.25, 0, 0.25])).toEqual(["−0.25", "0.00", "0.25"]);
  expect(tickWords([0, 10, 20])).toEqual(["0", "10", "20"]);
});

test("keys zoom and move within what there is", () => {
  const all = { min: 0, max: 100 };
  expect(zoomed(all, all, "+", false)).toEqual({ min: 25, max: 75 });
  expect(zoomed({ min: 25, max: 75 }, all, "-", false)).toEqual(all);
  expect(zoomed({ min: 80, max: 100 }, all, "ArrowRight", false)).toEqual({ min: 80, max: 100 });
  expect(zoomed({ min: 80, max: 100 }, all, "ArrowLeft", false)).toEqual({ min: 76, max: 96 });
  expect(zoomed({ min: 1, max: 2 }, all, "0", false)).toEqual(all);
  expect(zoomed(all, all, "x", false)).toBeNull();
  const decades = zoomed({ min: 1, max: 10000 }, { min: 1, max: 10000 }, "+", true)!;
  expect(decades.min).toBeCloseTo(10, 9);
  expect(decades.max).toBeCloseTo(1000, 6);
});
