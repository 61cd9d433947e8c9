import { Box3, PerspectiveCamera, Vector3 } from "three";
import { describe, expect, test } from "vitest";
import { fieldName, grouped, isChanged, type ConfigField } from "../src/ui/configFields";
import { withJob, type Job } from "../src/ui/job";
import { routeOf } from "../src/app/routes";
import { roundStep } from "../src/view3d/Ground";
import { directionOf, fitDistance, upOf, viewNames } from "../src/view3d/views";

const field = (path: string, value: ConfigField["value"], standard = value, description = ""): ConfigField => ({
  path,
  type: "number",
  value,
  default: standard,
  description,
});

test("config fields are grouped, searched and marked", () => {
  const fields = [field("trajectory.cutoff_Hz", 30, 20, "of the smoother"), field("trajectory.q", 1), field("profile.step_m", 1e-5), field("seed", 7)];
  expect(grouped(fields, "", false).map((group) => [group.name, group.fields.length])).toEqual([
    ["trajectory", 2],
    ["profile", 1],
    ["general", 1],
  ]);
  expect(grouped(fields, "SMOOTH cut", false).flatMap((group) => group.fields)).toEqual([fields[0]]);
  expect(grouped(fields, "", true).flatMap((group) => group.fields)).toEqual([fields[0]]);
  expect(isChanged({ ...field("a", 1), value: [1, 2], default: [1, 2] })).toBe(false);
});

test.each([
  ["trajectory.cutoff_Hz", "Cutoff", "Hz"],
  ["profile.step_m", "Step", "m"],
  ["contact.threshold_N", "Threshold", "N"],
  ["a.velocity_m_s", "Velocity", "m/s"],
  ["a.stiffness_N_per_m", "Stiffness", "N/m"],
  ["max_iterations", "Max iterations", ""],
])("%s is called %s in %s", (path, label, unit) => expect(fieldName(path)).toEqual({ label, unit }));

test("jobs come, change and go", () => {
  const job = (id: number, state: Job["state"], fraction = 0): Job => ({ id, title: "", stage: "", fraction, state });
  let list = withJob([], job(1, "waiting"));
  list = withJob(list, job(2, "waiting"));
  list = withJob(list, job(1, "running", 0.5));
  expect(list.map(({ id, fraction }) => [id, fraction])).toEqual([
    [1, 0.5],
    [2, 0],
  ]);
  expect(withJob(list, job(1, "done")).map(({ id }) => id)).toEqual([2]);
  expect(withJob(list, job(3, "failed"))).toHaveLength(2);
});

test("addresses lead to pages, and what is none to the first", () => {
  expect(routeOf("#/align").id).toBe("align");
  expect(routeOf("#token=abc").id).toBe("home");
  expect(routeOf("#/nowhere").id).toBe("home");
});

test("round steps are 1, 2 and 5", () => {
  expect([0.1, 0.19, 0.2, 0.49, 0.5, 0.99, 1].map(roundStep)).toEqual([0.1, 0.1, 0.2, 0.2, 0.5, 0.5, 1]);
});

test("the six sides are opposite in pairs, and top is up", () => {
  for (const up of ["-y", "y", "z"] as const) {
    const [top, bottom, front, back, left, right] = viewNames.map((name) => directionOf(name, up).normalize());
    expect(top!.dot(upOf(up))).toBeGreaterThan(0.99);
    expect(top!.dot(bottom!)).toBeLessThan(-0.99);
    expect(front!.dot(back!)).toBeCloseTo(-1, 12);
    expect(left!.dot(right!)).toBeCloseTo(-1, 12);
    expect(right!.clone().cross(upOf(up)).dot(front!)).toBeCloseTo(1, 12);
  }
});

test("the tracker's camera sees its own world upright: it stands at −z, and x is to the right", () => {
  expect(directionOf("front", "-y").toArray()).toEqual([0, 0, -1]);
  expect(directionOf("right", "-y").x).toBeCloseTo(1, 12);
});

describe("what a view shows", () => {
  const box = new Box3(new Vector3(1, 1, 1), new Vector3(5, 2, 3));
  const right_angle = Math.PI / 2;

  test("is as far away as its largest side wants", () => {
    // From the front 4 wide and 1 tall, its near face 1 before the middle: half the width over tan 45°, or of twice the width a quarter.
    expect(fitDistance(box, new Vector3(0, 0, 1), new Vector3(0, 1, 0), right_angle, 1)).toBeCloseTo(3, 12);
    expect(fitDistance(box, new Vector3(0, 0, 1), new Vector3(0, 1, 0), right_angle, 4)).toBeCloseTo(1.5, 12);
  });

  test("has all corners in the picture, from everywhere", () => {
    for (const name of [...viewNames, "home"] as const) {
      const from = directionOf(name, "z").normalize();
      const camera = new PerspectiveCamera(35, 1.6, 0.01, 100);
      camera.up.copy(upOf("z"));
      const centre = box.getCenter(new Vector3());
      camera.position.copy(centre).addScaledVector(from, fitDistance(box, from, camera.up, (35 * Math.PI) / 180, 1.6));
      camera.lookAt(centre);
      camera.updateMatrixWorld();
      let most = 0;
      for (const x of [1, 5]) for (const y of [1, 2]) for (const z of [1, 3]) {
        const seen = new Vector3(x, y, z).project(camera);
        most = Math.max(most, Math.abs(seen.x), Math.abs(seen.y));
      }
      expect(most).toBeCloseTo(1, 9);
    }
  });
});
