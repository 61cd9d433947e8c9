import { describe, expect, it } from "vitest";
import { pointsApart, toMesh, type Point, type Pose } from "../src/pages/align/pose";
import { colourLimitSigmas, inSigmas, residualColours } from "../src/pages/align/residuals";
import { areas, colourOf, markedPoints, overlapByPath, ownPoses, rmsByPath, rotationDegrees, scanName, scanRows } from "../src/pages/align/scans";

const still: Pose = [0, 0, 0, 1, 0, 0, 0];
const moved: Pose = [0.01, 0.02, -0.03, Math.SQRT1_2, 0, 0, Math.SQRT1_2];

describe("the list of scans", () => {
  it("has those that are worked on, then those of the scene", () => {
    const found = [
      { name: "a", placement: 1, T_mesh_world: still, rms_m: 1e-5, verdict: "valid" },
      { name: "scans/b.csv", placement: 2, T_mesh_world: moved, rms_m: 2e-5, verdict: "invalid" },
    ];
    const stored = [
      { name: "b", texture: 1, placement: 1, T_mesh_world: still, rms_m: 3e-5, verdict: "limited" },
      { name: "c", texture: 4 },
    ];
    const rows = scanRows(["a", "scans/b.csv"], found, null, [1e-4, 2e-4], stored);
    expect(rows.map(({ name }) => name)).toEqual(["a", "scans/b.csv", "b", "c"]);
    expect(rows.map(({ where }) => where)).toEqual(["this registration", "this registration", "replaced", "in the scene"]);
    expect(rows.map(({ verdict }) => verdict)).toEqual(["valid", "invalid", "limited", undefined]);
    expect(rows.map(({ rms_m }) => rms_m)).toEqual([1e-4, 2e-4, 3e-5, undefined]);
    expect(new Set(rows.map(({ key }) => key)).size).toBe(4);
  });

  it("shows the pose of the user where no registration is shown", () => {
    const [row] = scanRows(["a"], null, moved, [], []);
    expect(row).toMatchObject({ T_mesh_world: moved, where: "not registered", rms_m: null });
  });

  it("calls scans as the command line does, and has a colour for each of any number", () => {
    expect([scanName("deep/scan.csv"), scanName("first/"), scanName(".hidden"), scanName("a.b.csv")]).toEqual(["scan", "first", ".hidden", "a.b"]);
    expect([0, 7, 8].map(colourOf)).toEqual([1, 8, 1]);
  });
});

it("takes the distances of each path by themselves", () => {
  const rms = rmsByPath([3, 4, 2, -2], [0, 0, 1, 1], 3);
  expect(rms[0]).toBeCloseTo(Math.sqrt(12.5), 12);
  expect(rms[1]).toBeCloseTo(2, 12);
  expect(rms[2]).toBeNaN();
});

it("measures a rotation whichever sign its quaternion has", () => {
  expect(rotationDegrees(moved)).toBeCloseTo(90, 9);
  expect(rotationDegrees(moved.map((value, index) => (index > 2 ? -value : value)))).toBeCloseTo(90, 9);
});

describe("scans of several placements", () => {
  const frame = { middle_world_m: [0.1, 0, 0.2] as Point, origin_m: [0, 0, 0] as Point };

  it("have poses of their own, scans of one have not", () => {
    const scan = (placement: number, T_mesh_world: Pose) => ({ name: "s", placement, T_mesh_world });
    expect(ownPoses([scan(1, still), scan(1, still)], 2)).toBeNull();
    expect(ownPoses([scan(1, still), scan(2, moved)], 2)).toEqual([still, moved]);
    expect(ownPoses([scan(1, still), scan(2, moved)], 3)).toBeNull();
    expect(ownPoses(undefined, 2)).toBeNull();
  });

  it("are drawn where their own pose puts them", () => {
    const points = [0.01, 0.02, 0.03, -0.01, 0, 0.02];
    const drawn = pointsApart(points, [0, 1], moved, [moved, still], frame);
    const world = (values: ArrayLike<number>, at: number): Point => [0, 1, 2].map((k) => values[3 * at + k]! + frame.middle_world_m[k]!) as unknown as Point;
    const shown = [0, 1].map((at) => toMesh(moved, world(drawn, at)));
    const wanted = [toMesh(moved, world(points, 0)), toMesh(still, world(points, 1))];
    shown.forEach((point, at) => point.forEach((value, k) => expect(value).toBeCloseTo(wanted[at]![k]!, 7)));
  });
});

it("sorts triangles by their texture", () => {
  const found = areas([0, 1, 2, 2, 1, 3, 3, 1, 4], [0, 2], [5, 7]);
  expect([...found]).toEqual([
    [5, [0, 1, 2]],
    [7, [3, 1, 4]],
  ]);
});

describe("overlaps", () => {
  it("are the share of each path's marked points", () => {
    const share = overlapByPath([1, 0, 2, 3], [0, 0, 1, 1], 3);
    expect(share.slice(0, 2)).toEqual([0.5, 1]);
    expect(share[2]).toBeNaN();
    const [row] = scanRows(["a"], null, null, [], [], [0.25]);
    expect(row!.overlap).toBe(0.25);
  });

  it("are drawn at their points", () => {
    expect(Array.from(markedPoints([1, 2, 3, 4, 5, 6, 7, 8, 9], [0, 2, 1]))).toEqual([4, 5, 6, 7, 8, 9]);
  });
});

describe("distances over their σ", () => {
  it("are known where σ is", () => {
    const sigmas = inSigmas([3e-4, -2e-4, 1], [1e-4, 1e-4, NaN]);
    expect(sigmas[0]).toBeCloseTo(3, 5);
    expect(sigmas[1]).toBeCloseTo(-2, 5);
    expect(sigmas[2]).toBeNaN();
  });

  it("have a scale to 3 at least, of what is known", () => {
    expect(colourLimitSigmas([0.1, 0.2, NaN])).toBe(3);
    expect(colourLimitSigmas([NaN])).toBe(3);
    expect(colourLimitSigmas(Array.from({ length: 100 }, (_, index) => index / 10))).toBe(10);
  });

  it("have a colour of their own where they are not known", () => {
    const [r, g, b, ...near] = residualColours([NaN, 0], 3);
    expect([r, g, b]).not.toEqual(near);
    const ramp = residualColours([0, 1, 2, 3], 3);
    for (let index = 0; index < 12; index += 3) expect([ramp[index], ramp[index + 1], ramp[index + 2]]).not.toEqual([r, g, b]);
  });
});
