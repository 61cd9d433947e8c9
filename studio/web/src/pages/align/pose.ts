// Poses as the server writes them, and as three.js does. Lengths in metres.
import { Quaternion, Vector3, type Object3D } from "three";

/** T_mesh_world: x, y, z, qw, qx, qy, qz. */
export type Pose = readonly number[];
export type Point = readonly [number, number, number];

/** Where drawn things lie: the path's points are about `middle_world_m`, the mesh about `origin_m`. */
export interface Frame {
  middle_world_m: Point;
  origin_m: Point;
}

const position = (pose: Pose) => new Vector3(pose[0], pose[1], pose[2]);
const rotation = (pose: Pose) => new Quaternion(pose[4], pose[5], pose[6], pose[3]);
const point = (v: Vector3): Point => [v.x, v.y, v.z];

/** A point of the world in the mesh's frame. */
export const toMesh = (pose: Pose, p_world_m: Point): Point =>
  point(new Vector3(...p_world_m).applyQuaternion(rotation(pose)).add(position(pose)));

/** Where points about the path's middle are drawn if each path has its own pose and all are drawn by `pose`. */
export function pointsApart(points: ArrayLike<number>, pathOf: ArrayLike<number>, pose: Pose, poses: readonly Pose[], frame: Frame): Float32Array {
  const out = new Float32Array(points.length);
  const middle = new Vector3(...frame.middle_world_m);
  const back = rotation(pose).invert();
  const p = new Vector3();
  for (let at = 0; 3 * at < points.length; ++at) {
    const own = poses[pathOf[at]!] ?? pose;
    p.fromArray(Array.from({ length: 3 }, (_, k) => points[3 * at + k]!)).add(middle).applyQuaternion(rotation(own)).add(position(own));
    p.sub(position(pose)).applyQuaternion(back).sub(middle).toArray(out, 3 * at);
  }
  return out;
}

/** Poses the drawn path. */
export function placePath(path: Object3D, pose: Pose, frame: Frame): void {
  path.quaternion.copy(rotation(pose));
  path.position.set(...toMesh(pose, frame.middle_world_m)).sub(new Vector3(...frame.origin_m));
}

/** The pose of a drawn path that was moved by hand; its quaternion is unit and has qw >= 0. */
export function poseOfPath(path: Object3D, frame: Frame): Pose {
  const q = path.quaternion.clone().normalize();
  if (q.w < 0) q.set(-q.x, -q.y, -q.z, -q.w);
  const middle = new Vector3(...frame.middle_world_m).applyQuaternion(q);
  const p = path.position.clone().add(new Vector3(...frame.origin_m)).sub(middle);
  return [p.x, p.y, p.z, q.w, q.x, q.y, q.z];
}

export const samePose = (a: Pose | undefined, b: Pose | undefined): boolean =>
  a !== undefined && b !== undefined && a.length === b.length && a.every((value, index) => value === b[index]);
