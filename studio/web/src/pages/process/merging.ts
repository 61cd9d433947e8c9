// What the Merge tab keeps in the document, and what it makes of a merge (block "measured" with strokes on it).
import type { Block } from "../../net/block";
import type { Entry } from "../../ui/entries";
import { number, quantity } from "../../ui/format";
import type { MergeSection, ProcessSection } from "./processing";

/** One stroke of `passes` in result.json. */
export interface MergedStroke {
  name: string;
  used: boolean;
  direction: "forward" | "backward";
  shift_m: number;
  stretch: number;
  warp_rms_m: number;
  coherence: number | null;
  weight: number;
  noise_rms_m: number | null;
  stated_noise_rms_m: number | null;
  score: number;
  threshold: number;
}

export interface Gain {
  stroke_noise_rms_m: number | null;
  merged_noise_rms_m: number | null;
  share: number | null;
}

export const mergeOf = (section: ProcessSection): MergeSection => section.merge ?? { strokes: [], config: {} };

/** The section with a stroke more or less, in the order in which they were chosen. */
export function withStroke(section: ProcessSection, stroke: string, on: boolean): ProcessSection {
  const merge = mergeOf(section);
  const others = merge.strokes.filter((name) => name !== stroke);
  return { ...section, merge: { ...merge, strokes: on ? [...others, stroke] : others } };
}

/** What can be merged: the folder's recordings and results, and what is chosen though it is gone. */
export function strokeChoices(entries: readonly Entry[], chosen: readonly string[]): { name: string; kind: "recording" | "result" | "missing" }[] {
  const there = entries.flatMap(({ kind, name }) => (kind === "recording" || kind === "result" ? [{ name, kind }] : []));
  const known = new Set(there.map(({ name }) => name));
  return [...there, ...chosen.filter((name) => !known.has(name)).map((name) => ({ name, kind: "missing" as const }))];
}

/** All that a merge depends on: a merge with another key is out of date. */
export const mergeKey = (section: ProcessSection): string => JSON.stringify([mergeOf(section), section.config]);

/** The values that a merge has: it has no motion of its own. */
export const mergeFigures = <Figure extends { group: string; key: string }>(figures: readonly Figure[]): Figure[] =>
  figures.filter(({ group, key }) => group === "Roughness" || group === "Pattern" || key.startsWith("profile."));

export const strokesOf = (block: Block): MergedStroke[] => block.head.result.passes ?? [];
export const gainOf = (block: Block): Gain => block.head.gain;
export const agrees = (block: Block): boolean => block.head.result.merge.agrees;

/** The heights of each stroke at the merge's points, µm; `apart`: less the merge's own. */
export function strokeHeights_um(block: Block, apart: boolean): Float64Array[] {
  const texture = block.arrays.stroke_texture_m!;
  const merged = block.arrays.profile_texture_m!;
  const points = merged.length;
  return strokesOf(block).map((_, stroke) =>
    Float64Array.from({ length: points }, (__, i) => 1e6 * (texture[stroke * points + i]! - (apart ? merged[i]! : 0))),
  );
}

/** "0.49 of one stroke's noise", and what K equal strokes could have. */
export function gainWords({ share }: Gain, used: number): string {
  if (share == null) return "not known: the strokes do not state their noise";
  return `${number(share, 2)} of one stroke's noise (${number(1 / Math.sqrt(used), 2)} for ${used} equal strokes without a common error)`;
}

/** "1.3, 95 %: 0.9 to 1.8". */
export function ratioWords(merge: { noise_ratio: number | null; noise_ratio_low: number | null; noise_ratio_high: number | null }): string | null {
  if (merge.noise_ratio == null) return null;
  return `${number(merge.noise_ratio, 2)} times the power stated; 95\u202f%: ${number(merge.noise_ratio_low, 2)} to ${number(merge.noise_ratio_high, 2)}`;
}

/** The score of the test of one line and its threshold; the reference is not tested. */
export const agreementWords = ({ score, threshold }: MergedStroke): string =>
  score > 0 ? `${number(score, 3)} (≥ ${number(threshold, 2)})` : "reference";

export const micro = (value_m: number | null): string => quantity(value_m == null ? null : 1e6 * value_m, "", 3);
