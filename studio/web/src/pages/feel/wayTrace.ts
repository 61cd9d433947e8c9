/** Heights over the path length of the tip, the newest of them: a row only where the tip has moved. */
export class WayTrace {
  private way: number[] = [];
  private height: number[] = [];
  /** Grows with each change. */
  version = 0;

  constructor(
    private readonly most: number,
    private readonly step_mm = 0.002,
  ) {}

  append(way_mm: ArrayLike<number>, height_um: ArrayLike<number>): void {
    for (let index = 0; index < way_mm.length; ++index) {
      const last = this.way[this.way.length - 1];
      if (last !== undefined && !(way_mm[index]! >= last + this.step_mm)) continue;
      this.way.push(way_mm[index]!);
      this.height.push(height_um[index]!);
      ++this.version;
    }
    // Not at every append, or each would copy all of it.
    if (this.way.length > 2 * this.most) {
      this.way = this.way.slice(-this.most);
      this.height = this.height.slice(-this.most);
    }
  }

  rows(): { way_mm: number[]; height_um: number[] } {
    return { way_mm: this.way.slice(-this.most), height_um: this.height.slice(-this.most) };
  }

  clear(): void {
    this.way = [];
    this.height = [];
    ++this.version;
  }
}
