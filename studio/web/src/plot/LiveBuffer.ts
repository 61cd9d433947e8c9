import { minMax } from "./decimate";

/** The newest samples of some series with a common time, in a ring; the oldest make way. */
export class LiveBuffer {
  private readonly t: Float64Array;
  private readonly ys: Float64Array[];
  private next = 0;
  private count = 0;
  /** Grows with each append; shows whether there is something new. */
  version = 0;

  constructor(
    readonly seriesCount: number,
    readonly capacity = 1 << 17,
  ) {
    this.t = new Float64Array(capacity);
    this.ys = Array.from({ length: seriesCount }, () => new Float64Array(capacity));
  }

  get length(): number {
    return this.count;
  }

  get newest_s(): number {
    return this.count ? this.t[(this.next + this.capacity - 1) % this.capacity]! : 0;
  }

  /** Samples at rising times. Time that goes back (a new run) starts again. */
  append(t_s: ArrayLike<number>, ys: readonly ArrayLike<number>[]): void {
    if (t_s.length === 0) return;
    if (this.count > 0 && t_s[0]! < this.newest_s) this.clear();
    for (let index = Math.max(0, t_s.length - this.capacity); index < t_s.length; ++index) {
      this.t[this.next] = t_s[index]!;
      for (let series = 0; series < this.seriesCount; ++series) this.ys[series]![this.next] = ys[series]![index]!;
      this.next = (this.next + 1) % this.capacity;
    }
    this.count = Math.min(this.capacity, this.count + t_s.length);
    ++this.version;
  }

  clear(): void {
    this.next = 0;
    this.count = 0;
    ++this.version;
  }

  /** The newest value of a series, or NaN. */
  newest(series: number): number {
    return this.count ? this.ys[series]![(this.next + this.capacity - 1) % this.capacity]! : NaN;
  }

  /**
   * The last `window_s` seconds in buckets of equal time, two points each, written to `x` and `out` (as long as x).
   * Returns how many points were written. Buckets are fixed in time, so that the picture does not flicker as it moves.
   */
  recent(window_s: number, x: Float64Array, out: readonly Float64Array[]): number {
    const buckets = x.length >> 1;
    const step_s = window_s / (buckets - 1);
    let written = 0;
    let index = this.firstAfter(Math.floor((this.newest_s - window_s) / step_s) * step_s);
    while (index < this.count && written + 2 <= x.length) {
      const begin = this.at(index);
      const bucketEnd_s = (Math.floor(this.t[begin]! / step_s) + 1) * step_s;
      let end = index + 1;
      while (end < this.count && this.t[this.at(end)]! < bucketEnd_s && this.at(end) > begin) ++end;
      const last = this.at(end - 1);
      x[written] = this.t[begin]!;
      x[written + 1] = this.t[last]!;
      for (let series = 0; series < this.seriesCount; ++series) minMax(this.ys[series]!, begin, last + 1, out[series]!, written);
      written += 2;
      index = end;
    }
    return written;
  }

  /** The place in the ring of the index-th oldest sample. */
  private at(index: number): number {
    return (this.next - this.count + index + this.capacity) % this.capacity;
  }

  private firstAfter(t_s: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[this.at(middle)]! < t_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}
