// The scans of the page and those of its scene, one row each, and their colours.
import type { Pose } from "./pose";

/** A scan as the server knows it: of a registration, or stored in a scene. */
export interface ScanPose {
  name: string;
  placement?: number;
  T_mesh_world?: Pose;
  rms_m?: number | null;
  verdict?: string;
}

export interface StoredScan extends ScanPose {
  texture: number;
}

export interface ScanRow extends ScanPose {
  key: string;
  /** Which colour of the series, from 1. */
  colour: number;
  /** The share of its points where it overlaps another scan or a texture of the scene. */
  overlap?: number;
  where: "this registration" | "not registered" | "in the scene" | "replaced";
}

export const kColours = 8;
export const colourOf = (index: number): number => (index % kColours) + 1;

/** The last part of a path, without the ending of a file: what `register` calls the scan. */
export const scanName = (path: string): string => path.replace(/\/+$/, "").split("/").pop()!.replace(/(?<=.)\.[^.]*$/, "");

/**
 * The scans that are worked on, then those of the scene. `found` is the registration that is shown, null where the pose is
 * the user's, `placed` then; `rms_m` of the distances that are shown, one a path.
 */
export function scanRows(
  paths: readonly string[],
  found: readonly ScanPose[] | null,
  placed: Pose | null,
  rms_m: readonly number[],
  stored: readonly StoredScan[],
  overlap: readonly number[] = [],
): ScanRow[] {
  const own = paths.map((path, index): ScanRow => {
    const scan = found?.[index];
    return {
      key: `path ${path}`,
      name: path,
      colour: colourOf(index),
      placement: scan?.placement,
      T_mesh_world: scan?.T_mesh_world ?? placed ?? undefined,
      rms_m: rms_m[index] ?? null,
      overlap: overlap[index],
      verdict: scan?.verdict,
      where: scan ? "this registration" : "not registered",
    };
  });
  const names = new Set(paths.map(scanName));
  const there = stored.map((scan): ScanRow => ({
    ...scan,
    key: `stored ${scan.texture}`,
    colour: colourOf(paths.length + scan.texture - 1),
    where: names.has(scan.name) ? "replaced" : "in the scene",
  }));
  return [...own, ...there];
}

/** The root mean square of the distances of each path; NaN where one has no point. */
export function rmsByPath(distance_m: ArrayLike<number>, pathOf: ArrayLike<number>, paths: number): number[] {
  const square = new Array<number>(paths).fill(0);
  const count = new Array<number>(paths).fill(0);
  const points = Math.min(distance_m.length, pathOf.length);
  for (let index = 0; index < points; ++index) {
    const path = pathOf[index]!;
    if (path >= paths) continue;
    square[path] = square[path]! + distance_m[index]! ** 2;
    count[path] = count[path]! + 1;
  }
  return square.map((sum, path) => Math.sqrt(sum / count[path]!));
}

/** The share of each path's points that are marked; NaN where one has no point. */
export function overlapByPath(overlap: ArrayLike<number>, pathOf: ArrayLike<number>, paths: number): number[] {
  const marked = new Array<number>(paths).fill(0);
  const count = new Array<number>(paths).fill(0);
  for (let index = 0; index < Math.min(overlap.length, pathOf.length); ++index) {
    const path = pathOf[index]!;
    if (path >= paths) continue;
    marked[path] = marked[path]! + (overlap[index] ? 1 : 0);
    count[path] = count[path]! + 1;
  }
  return marked.map((sum, path) => sum / count[path]!);
}

/** The points, three numbers each, whose mark is not 0. */
export function markedPoints(positions: ArrayLike<number>, mark: ArrayLike<number>): Float32Array {
  const out: number[] = [];
  for (let index = 0; index < mark.length; ++index)
    if (mark[index]) out.push(positions[3 * index]!, positions[3 * index + 1]!, positions[3 * index + 2]!);
  return Float32Array.from(out);
}

/** The rotation of a pose by one angle, degrees. */
export const rotationDegrees = (pose: Pose): number => (2 * Math.acos(Math.min(1, Math.abs(pose[3]!))) * 180) / Math.PI;

/** The poses of the scans, one a path, where they are not all the same; null otherwise. */
export function ownPoses(scans: readonly ScanPose[] | undefined, paths: number): Pose[] | null {
  if (!scans || scans.length !== paths || new Set(scans.map(({ placement }) => placement)).size < 2) return null;
  return scans.every((scan) => scan.T_mesh_world) ? scans.map((scan) => scan.T_mesh_world!) : null;
}

/** Corners of some of a mesh's triangles: by texture index those that have it, and those that have several. */
export function areas(indices: ArrayLike<number>, triangles: ArrayLike<number>, textures: ArrayLike<number>): Map<number, number[]> {
  const out = new Map<number, number[]>();
  for (let index = 0; index < triangles.length; ++index) {
    const first = 3 * triangles[index]!;
    const corners = out.get(textures[index]!) ?? [];
    if (corners.length === 0) out.set(textures[index]!, corners);
    corners.push(indices[first]!, indices[first + 1]!, indices[first + 2]!);
  }
  return out;
}
