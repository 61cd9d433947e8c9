// How late the screen shows what a sensor has measured.

/** The host's clock against this browser's, by pings: the quickest of the last ones knows best. */
export class HostClock {
  private readonly pings: { offset_ms: number; trip_ms: number }[] = [];
  private static readonly most = 12;

  /** `sent_ms` and `heard_ms` by performance.now(), `host_ns` in between by the host. */
  add(sent_ms: number, host_ns: number, heard_ms: number): void {
    this.pings.push({ offset_ms: host_ns * 1e-6 - (sent_ms + heard_ms) / 2, trip_ms: heard_ms - sent_ms });
    if (this.pings.length > HostClock.most) this.pings.shift();
  }

  get known(): boolean {
    return this.pings.length > 0;
  }

  /** Half of the quickest trip: the offset is no worse than this. */
  get doubt_ms(): number {
    return this.best().trip_ms / 2;
  }

  /** A time of the host's in performance.now()'s. */
  toHere_ms(host_ns: number): number {
    return host_ns * 1e-6 - this.best().offset_ms;
  }

  private best() {
    return this.pings.reduce((best, ping) => (ping.trip_ms < best.trip_ms ? ping : best));
  }
}

/** Median and 95th percentile of the newest values. */
export class Recent {
  private readonly values: number[] = [];

  constructor(private readonly most = 200) {}

  add(value: number): void {
    this.values.push(value);
    if (this.values.length > this.most) this.values.shift();
  }

  clear(): void {
    this.values.length = 0;
  }

  quantile(share: number): number {
    if (this.values.length === 0) return NaN;
    const sorted = [...this.values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]!;
  }
}
