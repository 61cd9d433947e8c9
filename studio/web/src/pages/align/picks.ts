// Pairs of points that were picked on the path and on the mesh.
import type { Point } from "./pose";

export interface Pick {
  /** World frame, m. */
  path: Point;
  /** Mesh frame, m. */
  mesh: Point;
}

export interface Screen {
  x: number;
  y: number;
}

/** The index of the screen point nearest to another, or −1 if none is within `reach` pixels. */
export function nearestOnScreen(points: readonly (Screen | null)[], at: Screen, reach: number): number {
  let found = -1;
  let least = reach;
  points.forEach((point, index) => {
    if (!point) return;
    const distance = Math.hypot(point.x - at.x, point.y - at.y);
    if (distance > least) return;
    least = distance;
    found = index;
  });
  return found;
}

/** "12.3, 4.5, −6.0 mm". */
export function pointWords(p_m: Point): string {
  const words = p_m.map((value) => (1e3 * value).toFixed(1).replace("-", "\u2212"));
  return `${words.join(", ")}\u202fmm`;
}
