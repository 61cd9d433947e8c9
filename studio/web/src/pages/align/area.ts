// An area as the server has made it (block "align.area"), and what is drawn of it.
import type { VerdictEntry } from "../../measured/verdicts";
import { colourAt, colourRange, type ColourRange } from "../../measured/pathColours";
import type { MeasuredFigure } from "../../measured/measured";
import type { Block, NumberArray } from "../../net/block";

export interface AreaSection {
  /** That a registration of several scans has written. */
  folder: string;
  /** Settings that are not the defaults, as text. */
  config: Record<string, string>;
}

export type MapQuantity = "height" | "sigma";

export interface AreaMap {
  columns: number;
  rows: number;
  every: number;
  spacing_m: number;
}

/** What area.json states, as far as the page shows it. */
export interface AreaResult {
  trustworthy: boolean;
  verdict: string;
  verdicts: VerdictEntry[];
  patch: { triangles: number; filled: number; area_mm2: number; covered: number | null; textured_triangles: number; apart: string[] };
  parametrisation: { stretch_min: number; stretch_max: number };
  map: { columns: number; rows: number; spacing_mm: number; rms_m: number | null; sigma_rms_m: number | null; correlation_mm: number | null; agreement: number | null; agreement_sigma: number | null; ties: number };
  held_out: { strokes: number; error_rms_m: number | null; error_over_sigma: number | null };
  scans: { name: string; drift_rms_m?: number | null }[];
}

export const resultOf = (block: Block): AreaResult => block.head.area;
export const mapOf = (block: Block): AreaMap | null => block.head.map;

export const areaKey = (area: AreaSection | undefined): string => JSON.stringify([area?.folder ?? "", area?.config ?? {}]);

/** The values in µm; NaN in holes. */
export function mapValues_um(block: Block, what: MapQuantity): Float64Array {
  const values = block.arrays[what === "height" ? "height_m" : "sigma_m"] as NumberArray;
  const supported = block.arrays.supported!;
  return Float64Array.from({ length: values.length }, (_, at) => (supported[at] ? 1e6 * values[at]! : NaN));
}

/** The range of the colours; σ begins at 0. Null without a value. */
export function mapRange(values_um: ArrayLike<number>, what: MapQuantity): ColourRange | null {
  const range = colourRange(values_um);
  return range && what === "sigma" ? { low: 0, high: range.high } : range;
}

/** Four bytes a point, row after row; holes are transparent. */
export function mapPixels(values_um: ArrayLike<number>, range: ColourRange): Uint8ClampedArray {
  const out = new Uint8ClampedArray(4 * values_um.length);
  for (let at = 0; at < values_um.length; ++at) {
    const value = values_um[at]!;
    if (!Number.isFinite(value)) continue;
    const [r, g, b] = colourAt((value - range.low) / (range.high - range.low));
    out.set([255 * r, 255 * g, 255 * b, 255], 4 * at);
  }
  return out;
}

/** The share of the map's points without heights. */
export function holes(supported: ArrayLike<number>): number {
  let none = 0;
  for (let at = 0; at < supported.length; ++at) none += supported[at] ? 0 : 1;
  return none / Math.max(1, supported.length);
}

/** Corners of the textured triangles, three numbers each, and where each is in the picture, from its lower left as WebGL has it. */
export function patchCorners(block: Block): { positions: Float32Array; uv: Float32Array } {
  const { positions, indices, triangle, xy_mm } = block.arrays as Record<string, NumberArray>;
  const map = mapOf(block);
  const corners = 3 * triangle!.length;
  const out = { positions: new Float32Array(3 * corners), uv: new Float32Array(2 * corners) };
  if (!map) return out;
  const spacing_mm = 1e3 * map.spacing_m;
  for (let at = 0; at < corners; ++at) {
    const vertex = indices![3 * triangle![Math.floor(at / 3)]! + (at % 3)]!;
    for (let axis = 0; axis < 3; ++axis) out.positions[3 * at + axis] = positions![3 * vertex + axis]!;
    out.uv[2 * at] = (xy_mm![2 * at]! / spacing_mm + 0.5) / map.columns;
    out.uv[2 * at + 1] = 1 - (xy_mm![2 * at + 1]! / spacing_mm + 0.5) / map.rows;
  }
  return out;
}

const micro = (value: number | null) => (value == null ? null : 1e6 * value);

/** The area's values, as a table of them is made. */
export function areaFigures(result: AreaResult): MeasuredFigure[] {
  const { patch, parametrisation, map, held_out } = result;
  return [
    { group: "Patch", key: "patch.triangles", label: "Triangles", value: patch.triangles, unit: "", count: true },
    { group: "Patch", key: "patch.area_mm2", label: "Area", value: patch.area_mm2, unit: "mm²" },
    { group: "Patch", key: "patch.covered", label: "Share with heights", value: patch.covered == null ? null : 100 * patch.covered, unit: "%" },
    { group: "Patch", key: "parametrisation.stretch", label: "Stretch", value: `${parametrisation.stretch_min.toFixed(3)} to ${parametrisation.stretch_max.toFixed(3)}`, unit: "", hint: "1 where the plane keeps the surface's lengths" },
    { group: "Map", key: "map.rms_m", label: "Height, RMS", value: micro(map.rms_m), unit: "µm" },
    { group: "Map", key: "map.sigma_rms_m", label: "σ of a height, RMS", value: micro(map.sigma_rms_m), unit: "µm" },
    { group: "Map", key: "map.correlation_mm", label: "Correlation length", value: map.correlation_mm, unit: "mm" },
    { group: "Map", key: "map.spacing_mm", label: "Spacing of the points", value: map.spacing_mm || null, unit: "mm" },
    { group: "Strokes", key: "scans", label: "Scans", value: result.scans.length, unit: "", count: true },
    { group: "Strokes", key: "map.ties", label: "Pairs of strokes that meet", value: map.ties, unit: "", count: true },
    {
      group: "Strokes", key: "map.agreement", label: "Agreement", unit: "%", hint: "Share of their variance that the strokes have in common",
      value: map.agreement == null ? null : 100 * map.agreement, error: map.agreement_sigma == null ? null : 100 * map.agreement_sigma,
    },
    { group: "Strokes", key: "held_out.error_rms_m", label: "Left-out strokes: error, RMS", value: micro(held_out.error_rms_m), unit: "µm" },
    { group: "Strokes", key: "held_out.error_over_sigma", label: "Left-out strokes: error over σ", value: held_out.error_over_sigma, unit: "" },
  ];
}
