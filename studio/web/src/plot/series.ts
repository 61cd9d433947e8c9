// What a plot shows, and the data that uPlot needs for it.
import { decimate, lowerBound, type Keep } from "./decimate";

/** Names of the CSS variables --series-1 … 8, and the text's second colour. */
export type SeriesColour = 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | "muted" | "good" | "warn" | "bad";

export interface Series {
  label: string;
  y: ArrayLike<number>;
  /** Rising; without it the plot's x. */
  x?: ArrayLike<number>;
  /** A band round y, such as y ± its uncertainty. */
  lo?: ArrayLike<number>;
  hi?: ArrayLike<number>;
  kind?: "line" | "points" | "step";
  colour?: SeriesColour;
  dashed?: boolean;
  width?: number;
  hidden?: boolean;
}

export type Column = (number | null | undefined)[] | Float64Array;

/** Columns for uPlot: x, and for each series y, or lo, hi and y where it has a band. */
export interface Columns {
  data: Column[];
  /** Index in `data` of each series' y. */
  at: number[];
}

const columnsOf = (series: Series): ArrayLike<number>[] => (series.lo && series.hi ? [series.lo, series.hi, series.y] : [series.y]);
const keepOf = (series: Series): Keep[] => (series.lo && series.hi ? ["low", "high", "both"] : ["both"]);

/** The part of the series between two values of x, at most about two points a bucket and series. */
export function columnsBetween(x: ArrayLike<number> | undefined, series: readonly Series[], low: number, high: number, buckets: number): Columns {
  const at: number[] = [];
  let next = 1;
  for (const one of series) {
    next += columnsOf(one).length;
    at.push(next - 1);
  }
  const shared = series.every((one) => one.x === undefined || one.x === x);
  return { at, data: shared ? together(x ?? [], series, low, high, buckets) : merged(x ?? [], series, low, high, buckets) };
}

function together(x: ArrayLike<number>, series: readonly Series[], low: number, high: number, buckets: number): Column[] {
  const [from, to] = range(x, low, high);
  const few = decimate(x, series.flatMap(columnsOf), from, to, buckets, series.flatMap(keepOf));
  return [few.x, ...few.ys.map(gaps)];
}

function merged(x: ArrayLike<number>, series: readonly Series[], low: number, high: number, buckets: number): Column[] {
  const parts = series.map((one) => {
    const own = one.x ?? x;
    const [from, to] = range(own, low, high);
    return decimate(own, columnsOf(one), from, to, buckets, keepOf(one));
  });
  const places = parts.flatMap((part, index) => Array.from(part.x, (value, row) => ({ value, index, row })));
  places.sort((a, b) => a.value - b.value);
  const data: Column[] = [Float64Array.from(places, (place) => place.value)];
  parts.forEach((part, index) =>
    part.ys.forEach((y) => data.push(places.map((place) => (place.index === index ? (Number.isFinite(y[place.row]!) ? y[place.row]! : null) : undefined)))),
  );
  return data;
}

/** Indices of x between two values, with one neighbour at each side so that lines continue to the edge. */
function range(x: ArrayLike<number>, low: number, high: number): [number, number] {
  return [Math.max(0, lowerBound(x, low) - 1), Math.min(x.length, lowerBound(x, high) + 2)];
}

/** NaN as null, which uPlot draws as a gap. */
function gaps(values: Float64Array): Column {
  return values.every(Number.isFinite) ? values : Array.from(values, (value) => (Number.isFinite(value) ? value : null));
}

/** Index of the value of a rising x that is nearest; -1 if there is none. */
export function nearest(x: ArrayLike<number>, value: number): number {
  const above = lowerBound(x, value);
  if (above === 0) return x.length > 0 ? 0 : -1;
  if (above === x.length) return above - 1;
  return x[above]! - value < value - x[above - 1]! ? above : above - 1;
}

/** Smallest and largest x of all series; null if there is none. */
export function extent(x: ArrayLike<number> | undefined, series: readonly Series[]): [number, number] | null {
  let low = Infinity;
  let high = -Infinity;
  for (const one of series) {
    const own = one.x ?? x ?? [];
    if (own.length === 0) continue;
    low = Math.min(low, own[0]!);
    high = Math.max(high, own[own.length - 1]!);
  }
  return low <= high ? [low, high] : null;
}
