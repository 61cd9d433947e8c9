// The brush: a stroke that is drawn in one drag over the mesh, and the ring that shows its half-width.
import { LineBasicMaterial, LineLoop, BufferGeometry, Float32BufferAttribute, Vector3 } from "three";
import type { Point } from "./painting";

const kCorners = 64;
const kLeast = 0.01; // of the mesh's size: points closer than that follow the pointer's tremor

/** Distance between the points of a drag: the half-width, but no less than a hundredth of the mesh's size. */
export const spacing_m = (half_width_mm: number, size_m: number): number => Math.max(half_width_mm * 1e-3, kLeast * size_m);

/** The points with the next one, if it is far enough from the last. */
export function extended(points: readonly Point[], next: Point, apart_m: number): readonly Point[] {
  const last = points.at(-1);
  if (last && Math.hypot(next[0] - last[0], next[1] - last[1], next[2] - last[2]) < apart_m) return points;
  return [...points, next];
}

/** A circle of radius 1 about z; aim() lays it on the surface. */
export function ring(colour: string): LineLoop<BufferGeometry, LineBasicMaterial> {
  const corners = Array.from({ length: kCorners }, (_, index) => (2 * Math.PI * index) / kCorners).flatMap((angle) => [Math.cos(angle), Math.sin(angle), 0]);
  const made = new LineLoop(new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3)), new LineBasicMaterial({ color: colour, depthTest: false }));
  made.renderOrder = 1;
  return made;
}

/** Puts the ring at a point of the surface, with its radius and about its normal. */
export function aim(circle: LineLoop, point: Point, normal: Vector3, radius_m: number): void {
  circle.position.set(...point);
  circle.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal.clone().normalize());
  circle.scale.setScalar(radius_m);
}
