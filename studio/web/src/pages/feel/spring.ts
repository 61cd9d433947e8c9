// A spring as a line, for the eye.
import { add, cross, length, unit, type Point } from "./drag";

/** 3 × (4 turns + 3) numbers: a zigzag from a to b of half width `width`, with straight ends. */
export function springLine(a: Point, b: Point, width: number, turns: number): Float32Array {
  const way = add(b, a, -1);
  const along = unit(way) ?? [0, 0, 1];
  const across = unit(cross(along, Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]))!;
  const count = 4 * turns + 3;
  const out = new Float32Array(3 * count);
  const reach = Math.min(width, 0.5 * length(way));
  for (let index = 0; index < count; ++index) {
    const part = index / (count - 1);
    const isEnd = index < 2 || index > count - 3;
    const side = isEnd ? 0 : reach * Math.sin((Math.PI / 2) * (index - 1));
    out.set(add(add(a, way, part), across, side), 3 * index);
  }
  return out;
}
