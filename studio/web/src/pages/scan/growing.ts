// The profile and the tip's path as they grow by blocks (topics "scan.profile" and "scan.pose").
import type { Block, NumberArray } from "../../net/block";

/** Numbers that are appended to, in one array with room to grow. */
export class Column {
  private room = new Float64Array(1024);
  length = 0;

  get values(): Float64Array {
    return this.room.subarray(0, this.length);
  }

  append(values: ArrayLike<number>, factor = 1): void {
    const length = this.length + values.length;
    if (length > this.room.length) {
      const wider = new Float64Array(Math.max(length, 2 * this.room.length));
      wider.set(this.values);
      this.room = wider;
    }
    for (let index = 0; index < values.length; ++index) this.room[this.length + index] = values[index]! * factor;
    this.length = length;
  }

  clear(): void {
    this.length = 0;
  }
}

/**
 * What a stream of blocks has grown to. A block of a generation that begins at 0 starts again; one that does not continue
 * where the last ended asks for the whole.
 */
export class Growing<Names extends string> {
  readonly columns: Record<Names, Column>;
  generation = -1;
  /** Grows with each change. */
  version = 0;

  /** `names`: each array of the block with the factor to the unit that is shown. `width`: values a point of `names`. */
  constructor(
    private readonly names: Record<Names, number>,
    private readonly counted: NoInfer<Names>,
    private readonly askAll: () => void,
    private readonly width = 1,
  ) {
    this.columns = Object.fromEntries(Object.keys(names).map((name) => [name, new Column()])) as Record<Names, Column>;
  }

  get length(): number {
    return this.columns[this.counted].length / this.width;
  }

  take(block: Block): void {
    const { generation, first } = block.head as { generation: number; first: number };
    if (first === 0) this.begin(generation);
    else if (generation !== this.generation || first > this.length) return this.askAll();
    // A whole that was asked for may overlap with blocks that came meanwhile.
    const skip = this.length - first;
    for (const name of Object.keys(this.names) as Names[]) {
      const values = block.arrays[name] as NumberArray | undefined;
      if (!values) continue;
      this.columns[name].append(values.subarray(Math.min(values.length, skip * (block.shapes[name]?.[1] ?? 1))), this.names[name]);
    }
    ++this.version;
  }

  clear(): void {
    this.begin(-1);
    ++this.version;
  }

  private begin(generation: number): void {
    this.generation = generation;
    for (const column of Object.values<Column>(this.columns)) column.clear();
  }
}

/** Counts rows that a stream's blocks have left out; each states which row its first one is. */
export class RowCounter {
  private next = -1;
  rows = 0;
  lost = 0;

  take(sequence: number, rows: number): void {
    if (this.next >= 0 && sequence > this.next) this.lost += sequence - this.next;
    if (sequence < this.next) this.clear();
    this.next = sequence + rows;
    this.rows += rows;
  }

  clear(): void {
    this.next = -1;
    this.rows = 0;
    this.lost = 0;
  }
}

/** y ± sigma. */
export function band(y: Float64Array, sigma: Float64Array): { lo: Float64Array; hi: Float64Array } {
  const lo = new Float64Array(y.length);
  const hi = new Float64Array(y.length);
  for (let index = 0; index < y.length; ++index) {
    lo[index] = y[index]! - sigma[index]!;
    hi[index] = y[index]! + sigma[index]!;
  }
  return { lo, hi };
}
