// Fewer points that look the same: the smallest and the largest value of each bucket.

/** Which value of a bucket is kept: both, or twice the smallest or the largest, as the edges of a band need it. */
export type Keep = "both" | "low" | "high";

export interface Decimated {
  x: Float64Array;
  ys: Float64Array[];
}

/**
 * Values `from` … `to` (not included) of series with one common, rising x, in `buckets` of equal counts: two points a
 * bucket, each series with its smallest and largest value there, in the order in which they come, or what `keep` states
 * for it. What fits is copied.
 */
export function decimate(
  x: ArrayLike<number>,
  ys: readonly ArrayLike<number>[],
  from: number,
  to: number,
  buckets: number,
  keep: readonly Keep[] = [],
): Decimated {
  const count = Math.max(0, to - from);
  if (count <= 2 * buckets) {
    return { x: copied(x, from, to), ys: ys.map((y) => copied(y, from, to)) };
  }
  const result = { x: new Float64Array(2 * buckets), ys: ys.map(() => new Float64Array(2 * buckets)) };
  for (let bucket = 0; bucket < buckets; ++bucket) {
    const first = from + Math.floor((bucket * count) / buckets);
    const end = from + Math.floor(((bucket + 1) * count) / buckets);
    result.x[2 * bucket] = x[first]!;
    result.x[2 * bucket + 1] = x[end - 1]!;
    for (let series = 0; series < ys.length; ++series) {
      const out = result.ys[series]!;
      minMax(ys[series]!, first, end, out, 2 * bucket);
      const kept = keep[series] ?? "both";
      if (kept === "both") continue;
      const choose = kept === "low" ? Math.min : Math.max;
      out.fill(choose(out[2 * bucket]!, out[2 * bucket + 1]!), 2 * bucket, 2 * bucket + 2);
    }
  }
  return result;
}

/** Writes the smallest and the largest of y[first … end) to `out`, the earlier one first; NaN without a number. */
export function minMax(y: ArrayLike<number>, first: number, end: number, out: Float64Array, at: number): void {
  let lowest = -1;
  let highest = -1;
  for (let index = first; index < end; ++index) {
    const value = y[index]!;
    if (Number.isNaN(value)) continue;
    if (lowest < 0 || value < y[lowest]!) lowest = index;
    if (highest < 0 || value > y[highest]!) highest = index;
  }
  out[at] = lowest < 0 ? NaN : y[Math.min(lowest, highest)]!;
  out[at + 1] = lowest < 0 ? NaN : y[Math.max(lowest, highest)]!;
}

/** First index whose x is at least `value`, in a rising x. */
export function lowerBound(x: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (x[middle]! < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

function copied(values: ArrayLike<number>, from: number, to: number): Float64Array {
  const copy = new Float64Array(Math.max(0, to - from));
  for (let index = from; index < to; ++index) copy[index - from] = values[index]!;
  return copy;
}
