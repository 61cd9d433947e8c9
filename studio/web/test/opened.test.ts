import { expect, test } from "vitest";
import { editToOpen, pageOf } from "../src/app/opened";

const align = { paths: ["a"], mesh: "", mesh_unit: "mm", textures: [], config: {}, picks: [] };
const process = { scans: [{ recording: "a", segment: "s2" }], current: 0, config: {} };

test("a mesh is chosen on Align, and what belongs to another one goes", () => {
  const before = { ...align, mesh: "old.obj", picks: [{}], T_mesh_world: [0, 0, 0, 1, 0, 0, 0], registered: {} };
  expect(editToOpen("mesh", "new.obj", before)).toEqual({ path: "/align", value: { ...align, mesh: "new.obj" }, label: "open new.obj" });
  expect(editToOpen("mesh", "old.obj", before)).toBeNull();
});

test("a recording is added on Process, or looked at where it is there", () => {
  expect(editToOpen("recording", "b", process)?.value).toEqual({ ...process, scans: [...process.scans, { recording: "b", segment: "" }], current: 1 });
  expect(editToOpen("recording", "a", process)).toBeNull();
  const two = { ...process, scans: [...process.scans, { recording: "b", segment: "" }], current: 1 };
  expect(editToOpen("recording", "a", two)?.value).toEqual({ ...two, current: 0 });
});

test("a scene is chosen on Feel in the place of height maps", () => {
  const before = { scene: "", height_maps: ["a.png"], device: "mouse" };
  expect(editToOpen("scene", "scene.json", before)?.value).toEqual({ scene: "scene.json", height_maps: [], textures: {}, device: "mouse" });
  expect(editToOpen("scene", "scene.json", { scene: "scene.json" })).toBeNull();
});

test("what no page is for is left alone", () => {
  expect(pageOf("result")).toBeUndefined();
  expect(editToOpen("texture", "t.texture.json", {})).toBeNull();
});
