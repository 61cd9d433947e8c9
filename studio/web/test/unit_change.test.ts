import { describe, expect, it } from "vitest";
import { withObject, withUnitText, type PaintSection } from "../src/pages/paint/painting";
import { changesOfUnit } from "../src/state/unitChange";

const align = { paths: ["scan"], mesh: "a.obj", mesh_unit: "", picks: [{}], T_mesh_world: [0, 0, 0, 1, 0, 0, 0], registered: {}, config: { a: "1" } };
const paint: PaintSection = {
  object: "a.stl",
  rings: 1,
  half_width_mm: 2,
  strokes: [{ picks_m: [[0, 0, 0]], texture: "t", index: 1 }],
  swaps: {},
  current: 0,
  written: "",
};
const paths = (changes: { path: string }[]) => changes.map(({ path }) => path);

describe("another unit of the project", () => {
  it("removes what is of the scale of before, and is the first that undo takes back", () => {
    const changes = changesOfUnit({ align, paint }, "m", "mm");
    expect(paths(changes)).toEqual(["/align", "/paint", "/project/mesh_unit"]);
    expect(changes[0]!.value).toEqual({ paths: ["scan"], mesh: "a.obj", mesh_unit: "", picks: [], config: { a: "1" } });
    expect(changes[1]!.value).toEqual({ ...paint, strokes: [], current: -1 });
    expect(changes[2]!.value).toBe("mm");
  });

  it("leaves meshes with a unit of their own alone", () => {
    expect(paths(changesOfUnit({ align: { ...align, mesh_unit: "cm" }, paint: { ...paint, unit_m: 0.01 } }, "m", "mm"))).toEqual(["/project/mesh_unit"]);
    expect(paths(changesOfUnit({ align: { ...align, mesh: "a.glb" }, paint: { ...paint, object: "b/scene.json" } }, "m", "mm"))).toEqual(["/project/mesh_unit"]);
  });

  it("has nothing to remove where nothing was placed or drawn, or where the length is the same", () => {
    const empty = { paths: [], mesh: "a.obj", mesh_unit: "", picks: [] };
    expect(paths(changesOfUnit({ align: empty, paint: { ...paint, strokes: [] } }, "m", "mm"))).toEqual(["/project/mesh_unit"]);
    expect(paths(changesOfUnit({ align, paint }, "m", "1000mm"))).toEqual(["/project/mesh_unit"]);
    expect(paths(changesOfUnit({}, "m", "mm"))).toEqual(["/project/mesh_unit"]);
  });
});

describe("the mesh to paint", () => {
  it("loses its strokes in another unit", () => {
    expect(withUnitText(paint, "mm", "m")).toEqual({ ...paint, unit_m: 1e-3, strokes: [], current: -1 });
    expect(withUnitText({ ...paint, unit_m: 1e-3 }, "", "m")).toEqual({ ...paint, strokes: [], current: -1 });
  });

  it("keeps them where the unit is the same length", () => {
    expect(withUnitText(paint, "mm", "mm")).toEqual({ ...paint, unit_m: 1e-3 });
    expect(withUnitText({ ...paint, object: "a.glb" }, "m", "mm").strokes).toHaveLength(1);
  });

  it("does not give its unit to another", () => {
    const next = withObject({ ...paint, unit_m: 1e-3, written: "b/scene.json" }, "c.obj");
    expect(next).toEqual({ ...paint, object: "c.obj", strokes: [], current: -1 });
    expect("unit_m" in next).toBe(false);
  });
});
