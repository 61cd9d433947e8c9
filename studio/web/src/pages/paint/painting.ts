// What the page's section of the document holds, and how the colours of the painted mesh are made.
import { isSameUnit, textOfLength, unitInForce, unitOfText } from "../../ui/meshUnits";

export type Point = [number, number, number];

export interface Stroke {
  /** In the mesh's frame, metres. */
  picks_m: Point[];
  /** File in the project. */
  texture: string;
  /** Number under which the scene knows it. */
  index: number;
}

export interface PaintSection {
  object: string;
  /** Missing: the project's, unless the file states one. */
  unit_m?: number;
  rings: number;
  half_width_mm: number;
  strokes: Stroke[];
  swaps: Record<string, string>;
  /** The stroke that is drawn on; -1: none. */
  current: number;
  /** The scene that was last written with the present content; "": none, or the content has changed since. */
  written: string;
}

/** The unit that the page has chosen, as text; "": none. */
export const unitText = (paint: PaintSection): string => (paint.unit_m === undefined ? "" : textOfLength(paint.unit_m));

/** Another mesh or scene to paint on: nothing of the one before is kept, also its unit. */
export function withObject(paint: PaintSection, object: string): PaintSection {
  const { unit_m: _unit, ...kept } = paint;
  return { ...kept, object, strokes: [], swaps: {}, current: -1, written: "" };
}

/** The mesh in another unit, as text, "": none of the page. Strokes are in metres: those of another scale are removed. */
export function withUnitText(paint: PaintSection, text: string, projectUnit: string): PaintSection {
  const { unit_m: _unit, ...kept } = paint;
  const unit_m = text === "" ? null : unitOfText(text);
  const next: PaintSection = unit_m === null ? kept : { ...kept, unit_m };
  const inForce = (one: PaintSection) => unitInForce(one.object, unitText(one), projectUnit);
  return isSameUnit(inForce(paint), inForce(next)) ? next : { ...next, strokes: [], current: -1 };
}

/** What the server states of a stroke that it has painted, or why it could not. */
export interface StrokeFigures {
  fault?: string;
  path_length_m?: number;
  pick_distance_m?: number[];
  triangles?: number;
  painted_over?: number;
  warp?: { stretch_min: number; stretch_max: number; stretch_rms: number; folded: number; stretched: number; overlapping: number };
  problems?: { message: string }[];
}

export interface SceneTextureName {
  index: number;
  file: string;
  name: string;
}

/** The number that a texture has already in the strokes or the scene, or the next free one. */
export function indexOf(texture: string, strokes: readonly Stroke[], scene: readonly SceneTextureName[]): number {
  const same = strokes.find((stroke) => stroke.texture === texture);
  if (same) return same.index;
  const taken = [...strokes.map((stroke) => stroke.index), ...scene.map((one) => one.index)];
  return Math.max(0, ...taken) + 1;
}

export type Show = "textures" | "coordinates" | "warp";

/** From this factor on a texture counts as stretched or compressed: the server's own limit. */
export const kWarpLimit = 1.25;

/** Part of the limit in −1 … 1: 0 keeps lengths, 1 stretches and −1 squeezes by the limit or more; of equal ratios equal parts. */
export function warpPart(stretch: number): number {
  if (!Number.isFinite(stretch) || stretch === 0) return 0;
  const part = Math.log(Math.abs(stretch)) / Math.log(kWarpLimit);
  return Math.sign(stretch) * Math.min(1, part);
}

/** In words: "×1.03 longer" or "×1.10 shorter" on the texture than on the surface. */
export function warpWords(stretch: number): string {
  if (!Number.isFinite(stretch)) return "folded flat";
  const factor = Math.abs(stretch);
  if (factor < 1.0005) return "length preserved";
  return `${factor.toFixed(3)} times ${stretch > 0 ? "stretched" : "compressed"}`;
}

/** Side of a square of the chequer, mm: a round length of which the path has some twenty. */
export function chequer_mm(length_m: number): number {
  const wanted = (length_m * 1e3) / 20;
  const steps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];
  return steps.find((step) => step >= wanted) ?? 50;
}
