import { describe, expect, it } from "vitest";
import { infoRows, meshFaults, shownUnit, type MeshInfo } from "../src/ui/meshInfo";

/** A cube of 30 mm. */
const cube: MeshInfo = {
  objects: 1,
  unit_m: 1e-3,
  unit_from: "project",
  unit_text: "mm",
  likely: true,
  triangles: 12,
  vertices: 8,
  positions: 8,
  size_m: [0.03, 0.03, 0.03],
  area_m2: 5.4e-3,
  volume_m3: 2.7e-5,
  parts: 1,
  closed: true,
  open_edges: 0,
  edges: 18,
  edge_m: [0.03, 0.03, 0.03 * Math.SQRT2],
  non_manifold_edges: 0,
  non_manifold_vertices: 0,
  flipped_edges: 0,
  degenerate_triangles: 0,
  texture_coordinates: false,
  normals: true,
  textured_triangles: 0,
  problems: [],
};

const row = (info: MeshInfo, unit: string, label: string) => infoRows(info, unit).find((one) => one.label === label)?.value.replaceAll("\u202f", " ");

describe("mesh information", () => {
  it("is in the project's unit", () => {
    expect(row(cube, "mm", "Size x × y × z")).toBe("30.0 × 30.0 × 30.0 mm");
    expect(row(cube, "mm", "Surface area")).toBe("5400 mm²");
    expect(row(cube, "mm", "Volume")).toBe("27000 mm³");
    expect(row(cube, "cm", "Volume")).toBe("27.00 cm³");
    expect(row(cube, "25.4mm", "Edge length")).toBe("1.18 / 1.18 / 1.67 in");
    expect(shownUnit("0.06m")).toEqual({ name: "mm", unit_m: 1e-3 });
  });

  it("states who gave the unit", () => {
    expect(row(cube, "mm", "Unit")).toBe("Millimetre, the project's; the file states none");
    expect(row({ ...cube, unit_from: "file", unit_m: 1 }, "mm", "Unit")).toBe("Metre, stated by the file");
    expect(row({ ...cube, unit_from: "page", unit_text: "0.06m", unit_m: 0.06 }, "mm", "Unit")).toBe("0.06m, chosen on this page");
  });

  it("states what is missing or wrong", () => {
    const open = { ...cube, closed: false, open_edges: 1, volume_m3: null, vertices: 36, degenerate_triangles: 2, non_manifold_vertices: 1 };
    expect(row(open, "mm", "Closed")).toBe("No, 1 open edge");
    expect(row(open, "mm", "Volume")).toBe("None: the mesh is open");
    expect(row(open, "mm", "Vertices")).toBe("36, 8 different");
    expect(row(open, "mm", "Faults")).toBe("2 degenerate triangles, 1 non-manifold vertex");
    expect(row({ ...cube, volume_m3: null, flipped_edges: 3 }, "mm", "Volume")).toBe("None: the faces contradict one another");
    expect(row({ ...cube, volume_m3: null, non_manifold_edges: 2, flipped_edges: 2 }, "mm", "Volume")).toBe("None: edges of more than two triangles");
    expect(row({ ...cube, volume_m3: null, triangles: 0, closed: false }, "mm", "Volume")).toBe("None: no triangles");
    expect(meshFaults(cube)).toEqual([]);
    expect(row({ ...cube, objects: 2 }, "mm", "Meshes in the file")).toBe("2; the first is shown here");
  });
});
