import { Group, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { placePath, poseOfPath, samePose, toMesh, type Frame, type Point, type Pose } from "../src/pages/align/pose";

// A quarter turn about z, then 0.1, 0.2, 0.3 m: (x, y, z) goes to (0.1 − y, 0.2 + x, 0.3 + z).
const half = Math.SQRT1_2;
const quarter: Pose = [0.1, 0.2, 0.3, half, 0, 0, half];
const frame: Frame = { middle_world_m: [1, 2, 3], origin_m: [0.01, 0.02, 0.03] };

const close = (a: ArrayLike<number>, b: ArrayLike<number>, digits = 12) => {
  expect(a.length).toBe(b.length);
  Array.from(a, (value, index) => expect(value).toBeCloseTo(b[index]!, digits));
};

describe("poses", () => {
  it("map points as they do by hand", () => {
    close(toMesh(quarter, [1, 0, 0]), [0.1, 1.2, 0.3]);
    close(toMesh(quarter, [0, 1, 0]), [-0.9, 0.2, 0.3]);
    close(toMesh(quarter, [0, 0, 1]), [0.1, 0.2, 1.3]);
  });

  it("place the drawn path so that its matrix is the pose about its middle and the mesh's origin", () => {
    const path = new Group();
    placePath(path, quarter, frame);
    path.updateMatrix();
    // Columns of the quarter turn; the middle (1, 2, 3) goes to (−1.9, 1.2, 3.3), less the origin.
    close(path.matrix.elements, [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, -1.91, 1.18, 3.27, 1]);
    const world: Point = [1.5, 1.75, 3.25];
    const drawn = new Vector3(0.5, -0.25, 0.25).applyMatrix4(path.matrix);
    close(drawn.add(new Vector3(...frame.origin_m)).toArray(), toMesh(quarter, world));
  });

  it("come back from the drawn path, with qw not negative", () => {
    const path = new Group();
    placePath(path, quarter, frame);
    close(poseOfPath(path, frame), quarter);
    path.quaternion.set(0, 0, -half, -half);
    close(poseOfPath(path, frame), quarter);
  });

  it("turn about the path's middle, which stays", () => {
    const path = new Group();
    placePath(path, quarter, frame);
    path.rotateX(0.3);
    path.rotateY(-1.1);
    close(toMesh(poseOfPath(path, frame), frame.middle_world_m), toMesh(quarter, frame.middle_world_m));
  });

  it("are the same only number by number", () => {
    expect(samePose(quarter, [...quarter])).toBe(true);
    expect(samePose(quarter, undefined)).toBe(false);
    expect(samePose(quarter, [0.1, 0.2, 0.3, half, 0, 1e-17, half])).toBe(false);
  });
});
