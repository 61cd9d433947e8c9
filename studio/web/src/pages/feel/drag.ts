// Where the pointer's target is: over a point of the surface, by a height that is negative while it presses.

export type Point = [number, number, number];

export interface Ray {
  origin: Point;
  direction: Point;
}

/** A point of the surface with its normal, and the target's height over it along that. */
export interface Target {
  place: Point;
  normal: Point;
  height_m: number;
}

export const add = (a: Point, b: Point, factor = 1): Point => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Point): number => Math.hypot(a[0], a[1], a[2]);

/** A vector of length 1, or null for one without a direction. */
export function unit(a: Point): Point | null {
  const size = length(a);
  return size > 0 && Number.isFinite(size) ? [a[0] / size, a[1] / size, a[2] / size] : null;
}

export const pointOf = ({ place, normal, height_m }: Target): Point => add(place, normal, height_m);

const kGrazing = 0.05; // of a ray against a plane, as the sine of the angle between them

/**
 * Where a ray meets the plane through `place` with `normal`; null behind the viewer, and where the ray only grazes it:
 * a pixel would be a long distance.
 */
export function onPlane(ray: Ray, place: Point, normal: Point): Point | null {
  const toward = dot(ray.direction, normal);
  if (Math.abs(toward) < kGrazing * length(ray.direction) * length(normal)) return null;
  const way = dot(add(place, ray.origin, -1), normal) / toward;
  return way > 0 ? add(ray.origin, ray.direction, way) : null;
}

/** The direction along a surface that looks like `wish` to the viewer: its part within the plane, of length 1. */
export function alongSurface(wish: Point, normal: Point, otherwise: Point): Point {
  const within = (v: Point) => unit(add(v, normal, -dot(v, normal)));
  const size = length(wish);
  const part = within(wish);
  const isClear = part !== null && length(add(wish, normal, -dot(wish, normal))) > 1e-3 * size;
  return (isClear ? part : within(otherwise)) ?? within([normal[1], normal[2], normal[0]]) ?? [1, 0, 0];
}

export interface PressLimits {
  hover_m: number;
  deepest_m: number;
}

/** The height after a step up (or down, negative), never beyond the limits. */
export const raised = (height_m: number, step_m: number, { hover_m, deepest_m }: PressLimits): number =>
  Math.min(hover_m, Math.max(-deepest_m, height_m + step_m));

/** How deep a pen presses by its pressure from 0 to 1; a mouse, whose pressure is always a half, as deep as is set. */
export function pressDepth(depth_m: number, pointerType: string, pressure: number): number {
  return pointerType === "pen" && pressure > 0 ? 2 * depth_m * pressure : depth_m;
}
