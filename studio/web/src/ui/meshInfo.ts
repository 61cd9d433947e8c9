// What a mesh is, as the server has measured it, in words and in the project's unit.
import { number, withUnit } from "./format";
import { unitLabel, unitOfText, unitShort } from "./meshUnits";

export interface MeshInfo {
  /** Meshes of the file; the first is measured. */
  objects: number;
  unit_m: number;
  unit_from: "file" | "page" | "project";
  unit_text: string;
  likely: boolean;
  triangles: number;
  vertices: number;
  positions: number;
  size_m: [number, number, number];
  area_m2: number;
  volume_m3: number | null;
  parts: number;
  closed: boolean;
  open_edges: number;
  edges: number;
  /** Shortest, median, longest. */
  edge_m: [number, number, number];
  non_manifold_edges: number;
  non_manifold_vertices: number;
  flipped_edges: number;
  degenerate_triangles: number;
  texture_coordinates: boolean;
  normals: boolean;
  textured_triangles: number;
  problems: string[];
}

export interface InfoRow {
  label: string;
  value: string;
  hint?: string;
}

/** The unit that lengths are shown in: the project's if it has a name, else millimetres. */
export function shownUnit(text: string): { name: string; unit_m: number } {
  const name = unitShort(text);
  return name ? { name, unit_m: unitOfText(text)! } : { name: "mm", unit_m: 1e-3 };
}

const FROM = { file: "stated by the file", page: "chosen on this page", project: "the project's; the file states none" };
const yesNo = (is: boolean): string => (is ? "Yes" : "No");
const counted = (count: number, one: string, more: string): string => `${count} ${count === 1 ? one : more}`;

/** Counts of what is wrong with a mesh; empty: nothing. */
export function meshFaults(info: MeshInfo): string[] {
  return [
    info.degenerate_triangles > 0 && counted(info.degenerate_triangles, "degenerate triangle", "degenerate triangles"),
    info.non_manifold_edges > 0 && counted(info.non_manifold_edges, "non-manifold edge", "non-manifold edges"),
    info.non_manifold_vertices > 0 && counted(info.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices"),
    info.flipped_edges > 0 && counted(info.flipped_edges, "edge with opposite faces", "edges with opposite faces"),
  ].filter((one) => one !== false);
}

function volumeWords(info: MeshInfo, name: string, unit_m: number): string {
  if (info.volume_m3 !== null) return withUnit(number(info.volume_m3 / unit_m ** 3, 4), `${name}³`);
  if (info.triangles === 0) return "None: no triangles";
  if (!info.closed) return "None: the mesh is open";
  if (info.non_manifold_edges > 0) return "None: edges of more than two triangles";
  return "None: the faces contradict one another";
}

/** The rows of the table; `projectUnit` is the project's unit as text. */
export function infoRows(info: MeshInfo, projectUnit: string): InfoRow[] {
  const { name, unit_m } = shownUnit(projectUnit);
  const several = (lengths_m: readonly number[], between: string) => withUnit(lengths_m.map((one) => number(one / unit_m, 3)).join(between), name);
  const faults = meshFaults(info);
  const rows: (InfoRow | false)[] = [
    info.objects > 1 && { label: "Meshes in the file", value: `${info.objects}; the first is shown here` },
    { label: "Unit", value: `${unitLabel(info.unit_from === "file" ? `${info.unit_m}m` : info.unit_text)}, ${FROM[info.unit_from]}` },
    { label: "Size x × y × z", value: several(info.size_m, " × ") },
    { label: "Surface area", value: withUnit(number(info.area_m2 / unit_m ** 2, 4), `${name}²`) },
    { label: "Volume", value: volumeWords(info, name, unit_m) },
    { label: "Triangles", value: `${info.triangles}` },
    { label: "Vertices", value: info.vertices === info.positions ? `${info.vertices}` : `${info.vertices}, ${info.positions} different`, hint: "Vertices at the same position count as one; unused ones do not count" },
    { label: "Closed", value: info.closed ? "Yes" : `No, ${counted(info.open_edges, "open edge", "open edges")}` },
    { label: "Connected parts", value: `${info.parts}` },
    { label: "Edge length", value: several(info.edge_m, " / "), hint: "Shortest, median and longest" },
    { label: "Faults", value: faults.length > 0 ? faults.join(", ") : "None" },
    { label: "Texture coordinates", value: yesNo(info.texture_coordinates) },
    { label: "Normals", value: yesNo(info.normals) },
    info.textured_triangles > 0 && { label: "Triangles with a texture", value: `${info.textured_triangles}` },
  ];
  return rows.filter((row): row is InfoRow => row !== false);
}
