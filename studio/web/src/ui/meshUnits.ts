// The unit of a mesh file: files of meshes do not say it, so people do, in the same words on every page.

export interface MeshUnit {
  /** As the command line and the document take it. */
  text: string;
  label: string;
  unit_m: number;
}

export const meshUnits: readonly MeshUnit[] = [
  { text: "mm", label: "Millimetre", unit_m: 1e-3 },
  { text: "cm", label: "Centimetre", unit_m: 1e-2 },
  { text: "m", label: "Metre", unit_m: 1 },
  { text: "25.4mm", label: "Inch", unit_m: 0.0254 },
];

const LENGTHS: Record<string, number> = { nm: 1e-9, um: 1e-6, µm: 1e-6, mm: 1e-3, cm: 1e-2, m: 1 };

/** The metres of "mm", "0.06m" or "25.4 mm"; of nothing a metre; null for anything that is not a length. */
export function unitOfText(text: string): number | null {
  if (text.trim() === "") return 1;
  const found = /^\s*(\d+\.?\d*(?:e[+-]?\d+)?|\.\d+)?\s*(nm|um|µm|mm|cm|m)\s*$/i.exec(text);
  if (!found) return null;
  const unit_m = Number(found[1] ?? "1") * LENGTHS[found[2]!]!;
  return unit_m > 0 ? Number(unit_m.toPrecision(15)) : null;
}

/** The one of the list that is this long; null for any other length. */
export const unitOfLength = (unit_m: number): MeshUnit | null => meshUnits.find((one) => Math.abs(one.unit_m - unit_m) <= 1e-9 * one.unit_m) ?? null;

/** A length as the document's text. */
export const textOfLength = (unit_m: number): string => unitOfLength(unit_m)?.text ?? `${Number((unit_m * 1e3).toPrecision(12))}mm`;

/** A unit in words: "Millimetre", or its length. */
export const unitLabel = (text: string): string => {
  const unit_m = unitOfText(text);
  return (unit_m === null ? null : unitOfLength(unit_m)?.label) ?? text;
};

/** Files that state their unit: of glTF files it is the metre, and a scene has its own. */
const statesItsUnit = (file: string): boolean => /\.(json|gltf|glb)$/i.test(file);

/** True of a mesh that is read in the project's unit; `own` is what a page has chosen for it, "": nothing. */
export const takesProjectUnit = (file: string, own: string): boolean => file !== "" && own === "" && !statesItsUnit(file);

/** The unit in which a mesh file is read, as text: the page's, else the file's or the project's. */
export const unitInForce = (file: string, own: string, projectUnit: string): string => own || (statesItsUnit(file) ? "m" : projectUnit);

/** True where two texts are the same length. */
export const isSameUnit = (one: string, other: string): boolean => unitOfText(one) === unitOfText(other);

const SHORT: Record<string, string> = { m: "m", cm: "cm", mm: "mm", um: "µm", µm: "µm", nm: "nm", "25.4mm": "in" };

/** The sign of a unit that has one. */
export const unitShort = (text: string): string | undefined => SHORT[text.replace(/\s/g, "")];
