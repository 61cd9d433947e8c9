// What the server has measured of one recording (block "measured"), as the components of this folder show it. None of
// them needs a connection: the report shows the same.
import type { Block, NumberArray } from "../net/block";
import { quantity, withError } from "../ui/format";
import { verdictsOf, type VerdictEntry } from "./verdicts";

/** A value as the server names it: name, unit and factor are its (studio/report/src/metric_rows.cc), digits are ours. */
export interface MeasuredFigure {
  group: string;
  key: string;
  label: string;
  value: number | string | null;
  error?: number | null;
  unit: string;
  /** A whole number, shown without decimals. */
  count?: boolean;
  hint?: string;
}

export interface Dropped {
  kind: string;
  message: string;
  count: number;
}

export interface Gap {
  from_m: number;
  to_m: number;
  why: string;
}

export interface Measured {
  name: string;
  object: string;
  trustworthy: boolean;
  verdict: string;
  verdicts: VerdictEntry[];
  version: string;
  method: string;
  world: string;
  figures: MeasuredFigure[];
  dropped: Dropped[];
  gaps: Gap[];
  gapCount: number;
  config: Record<string, unknown>;
  trajectory: { samples: number; every: number; points: number; duration_s: number };
  profile: { samples: number; every: number; points: number; first_m: number; spacing_m: number };
  compliance: {
    k_c: number | null;
    k_c_stderr?: number | null;
    k_c_low?: number | null;
    k_c_high?: number | null;
    verdict?: string;
    sigma_r2: number | null;
    exponent: number | null;
    exponent_error: number | null;
  };
  segments: string[];
  segment: string;
  array(name: string): NumberArray;
}

/** What the y axes of plots over the same way take at the left. */
export const kAxisRoom_px = 46;

const NONE = new Float32Array(0);

/** The block's parts by name. Throws for a block of another kind. */
export function measuredOf(block: Block): Measured {
  if (block.kind !== "measured") throw new Error(`"${block.kind}" contains no measurement`);
  const { head } = block;
  const { result } = head;
  return {
    name: result.recording,
    object: result.object,
    trustworthy: result.trustworthy,
    verdict: result.verdict,
    verdicts: verdictsOf(result),
    version: result.asperity,
    method: result.method,
    world: head.world,
    figures: head.figures,
    dropped: head.dropped,
    gaps: head.gaps,
    gapCount: head.gap_count,
    config: result.config,
    trajectory: head.trajectory,
    profile: head.profile,
    compliance: head.compliance,
    segments: head.segments ?? [],
    segment: head.scan?.segment ?? "",
    array: (name) => block.arrays[name] ?? NONE,
  };
}

/** The profile's arc length in mm, a number a point. */
export function profileX_mm({ profile }: Measured): Float64Array {
  return Float64Array.from({ length: profile.points }, (_, i) => 1e3 * (profile.first_m + i * profile.spacing_m));
}

export const scaled = (values: ArrayLike<number>, factor: number): Float64Array =>
  Float64Array.from({ length: values.length }, (_, i) => values[i]! * factor);

/** y − k·σ and y + k·σ, or nothing where no σ is known. */
export function band(y: ArrayLike<number>, sigma: ArrayLike<number>, k: number): { lo: Float64Array; hi: Float64Array } | null {
  if (sigma.length !== y.length || !Array.prototype.some.call(sigma, Number.isFinite)) return null;
  return {
    lo: Float64Array.from({ length: y.length }, (_, i) => y[i]! - k * sigma[i]!),
    hi: Float64Array.from({ length: y.length }, (_, i) => y[i]! + k * sigma[i]!),
  };
}

/** A value as it is shown: counts without decimals. */
export const figureValue = ({ value, count }: MeasuredFigure): number | string | null => (count && value != null ? String(value) : value);

/** A value as text, for tables. */
export function figureWords(figure: MeasuredFigure): string {
  const value = figureValue(figure);
  if (typeof value === "string") return value;
  return figure.error == null ? quantity(value, figure.unit) : withError(value, figure.error, figure.unit);
}

/** The values for a table of another program: all digits, in their units. */
export const figureRows = (figures: readonly MeasuredFigure[]): string[][] => [
  ["group", "figure", "key", "value", "standard_error", "unit"],
  ...figures.map(({ group, label, key, value, error, unit }) => [group, label, key, value == null ? "" : String(value), error == null ? "" : String(error), unit]),
];

/** The values by their groups, in their order. */
export function figureGroups(figures: readonly MeasuredFigure[]): { name: string; figures: MeasuredFigure[] }[] {
  const groups = new Map<string, MeasuredFigure[]>();
  for (const figure of figures) groups.set(figure.group, [...(groups.get(figure.group) ?? []), figure]);
  return [...groups].map(([name, members]) => ({ name, figures: members }));
}

/** A config's leaves with their dotted paths, in order. */
export function configRows(config: unknown, path = ""): { path: string; value: string }[] {
  if (config === null || typeof config !== "object" || Array.isArray(config)) return [{ path, value: JSON.stringify(config) }];
  return Object.entries(config).flatMap(([key, value]) => configRows(value, path ? `${path}.${key}` : key));
}

/** Points of a spectrum that logarithmic axes can show. */
export function positivePoints(x: ArrayLike<number>, y: ArrayLike<number>): { x: Float64Array; y: Float64Array } {
  const at = Array.from({ length: x.length }, (_, i) => i).filter((i) => x[i]! > 0 && y[i]! > 0);
  return { x: Float64Array.from(at, (i) => x[i]!), y: Float64Array.from(at, (i) => y[i]!) };
}

/** A spectrum as logarithmic axes can show it: what is 0, as where there is no more than noise, is drawn at the lowest value above it. */
export function spectrumPoints(
  x: ArrayLike<number>,
  y: ArrayLike<number>,
  lo: ArrayLike<number>,
  hi: ArrayLike<number>,
): { x: Float64Array; y: Float64Array; lo: Float64Array | null; hi: Float64Array | null } {
  const known = lo.length === x.length && hi.length === x.length && Array.prototype.some.call(hi, (v: number) => v > 0);
  if (!known) return { ...positivePoints(x, y), lo: null, hi: null };
  const at = Array.from({ length: x.length }, (_, i) => i).filter((i) => x[i]! > 0 && hi[i]! > 0);
  const lowest = Math.min(...at.flatMap((i) => [y[i]!, lo[i]!, hi[i]!]).filter((v) => v > 0));
  const of = (values: ArrayLike<number>) => Float64Array.from(at, (i) => Math.max(values[i]!, lowest));
  return { x: Float64Array.from(at, (i) => x[i]!), y: of(y), lo: of(lo), hi: of(hi) };
}

/** Both sorted by x, as plots need their points. */
export function sortedByX(x: ArrayLike<number>, y: ArrayLike<number>): { x: Float64Array; y: Float64Array } {
  const at = Array.from({ length: x.length }, (_, i) => i).sort((a, b) => x[a]! - x[b]!);
  return { x: Float64Array.from(at, (i) => x[i]!), y: Float64Array.from(at, (i) => y[i]!) };
}

/** "every 3rd of 90 000 samples"; empty if all are there. */
export function thinnedWords(what: { samples: number; every: number }, things: string): string {
  return what.every <= 1 ? "" : `One of every ${what.every} of ${what.samples.toLocaleString("en").replaceAll(",", "\u202f")} ${things} is shown.`;
}
