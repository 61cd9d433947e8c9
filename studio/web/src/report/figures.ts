// What a result has measured, in words and with units.
import { quantity, withError } from "../ui/format";

export interface FigureRow {
  label: string;
  value: number | string | null;
  error?: number | null;
  unit?: string;
  factor?: number;
  hint?: string;
}

export interface FigureGroup {
  title: string;
  rows: FigureRow[];
}

type Json = Record<string, any> | null | undefined;

const mm = { unit: "mm", factor: 1e3 };
const um = { unit: "µm", factor: 1e6 };
const perSecond = { unit: "mm/s", factor: 1e3 };
const share = { unit: "%", factor: 100 };

/** All figures of a result.json, in groups; what it does not have is left out. */
export function figureGroups(result: Record<string, any>): FigureGroup[] {
  return [scan(result), surface(result.roughness, result.periodicity), contact(result), shape(result.base), texture(result.texture), accuracy(result.accuracy), trajectory(result.trajectory)]
    .map((group) => ({ ...group, rows: group.rows.filter((row) => row.value != null) }))
    .filter((group) => group.rows.length > 0);
}

function scan(r: Record<string, any>): FigureGroup {
  return {
    title: "The scan",
    rows: [
      { label: "Length of the path", value: r.length_m, ...mm },
      { label: "Length with heights", value: r.profile?.length_m, ...mm },
      { label: "Covered", value: r.profile?.covered, ...share, hint: "part of the length with heights that is not a gap" },
      { label: "Gaps", value: count(r.profile?.gaps) },
      { label: "Distance of the heights", value: r.profile?.spacing_m, ...um },
      { label: "Duration", value: r.duration_s, unit: "s" },
      { label: "Speed, mean", value: r.speed_mps?.mean, ...perSecond },
      { label: "Speed, lowest", value: r.speed_mps?.lowest, ...perSecond },
      { label: "Speed, highest", value: r.speed_mps?.highest, ...perSecond },
      { label: "Samples of the probe", value: count(r.samples?.probe) },
      { label: "Poses of the tracker", value: count(r.samples?.tracker) },
    ],
  };
}

function surface(r: Json, p: Json): FigureGroup {
  const height = (name: string, hint: string): FigureRow => ({ label: name, value: r?.[`${name}_m`] ?? null, ...um, hint });
  return {
    title: "The surface",
    rows: [
      height("Ra", "mean of the height's magnitude"),
      height("Rq", "root mean square of the height"),
      height("Rz", "mean of the sections' largest height differences"),
      height("Rt", "largest height difference"),
      { label: "Rsk", value: r?.Rsk, hint: "skewness" },
      { label: "Rku", value: r?.Rku, hint: "kurtosis" },
      { label: "RSm", value: r?.RSm_m, ...mm, hint: "mean width of the profile's elements" },
      height("R5p", "five-point peak height"),
      height("R5v", "five-point pit depth"),
      height("R10z", "ten-point height"),
      height("Rcm10", "height above which 10 % of the material is"),
      height("Rcm50", "height above which 50 % of the material is"),
      height("Rcm90", "height above which 90 % of the material is"),
      { label: "Periodic", value: p ? (p.periodic ? "yes" : "no") : null },
      { label: "Pitch", value: p?.periodic ? p.pitch_m : null, error: p?.pitch_stderr_m, ...mm },
      { label: "Depth of a period", value: p?.periodic ? p.depth_m : null, error: p?.depth_stderr_m, ...um },
      { label: "Periods", value: p?.periodic ? count(p.periods) : null },
    ],
  };
}

function contact(r: Record<string, any>): FigureGroup {
  const s = r.stiffness;
  return {
    title: "The contact",
    rows: [
      { label: "Stiffness", value: s?.measured ? s.stiffness_N_per_mm : null, error: s?.stiffness_stderr_N_per_mm, unit: "N/mm" },
      { label: "Stiffness, at least", value: s && !s.measured ? s.lower_bound_N_per_mm : null, unit: "N/mm" },
      { label: "Compliance", value: s?.compliance_mm_per_N, error: s?.compliance_stderr_mm_per_N, unit: "mm/N" },
      { label: "Force varied by (rms)", value: s?.force_rms_N, unit: "N" },
      { label: "What it means", value: s?.verdict || null },
      { label: "Compliance coefficient k_c", value: r.compliance?.k_c, hint: "compliance coefficient: 1 for stiff, towards 0 for soft" },
    ],
  };
}

function shape(b: Json): FigureGroup {
  return {
    title: "The shape under the path",
    rows: [
      { label: "Shape", value: b?.shape ?? null },
      { label: "Radius", value: b?.radius_m, error: b?.radius_stderr_m, ...mm },
      { label: "Off the shape (rms)", value: b?.base_rms_m, ...um },
      { label: "Normal known to", value: b?.normal_sigma_deg, unit: "°" },
      { label: "Probe's tilt", value: b?.probe_tilt_deg, unit: "°" },
      { label: "Turning points", value: count(b?.turning_points) },
    ],
  };
}

function texture(t: Json): FigureGroup {
  return {
    title: "The texture",
    rows: [
      { label: "Length", value: t?.length_mm, unit: "mm" },
      { label: "Harmonics", value: count(t?.harmonics) },
      { label: "Height (rms)", value: t?.rms_height_m, ...um },
      { label: "Error of the fit (rms)", value: t?.rms_error_m, ...um },
    ],
  };
}

function accuracy(a: Json): FigureGroup {
  return {
    title: "Against the truth",
    rows: [
      { label: "Correlation of the heights", value: a?.correlation },
      { label: "Gain", value: a?.gain },
      { label: "Height error (rms)", value: a?.rms_um, unit: "µm" },
      { label: "True height (rms)", value: a?.true_rms_um, unit: "µm" },
      { label: "Length error", value: a?.length_error_percent, unit: "%" },
      { label: "Position error (rms)", value: a?.position_rms_m, ...um },
      { label: "Tracker's error (rms)", value: a?.tracker_rms_m, ...um },
    ],
  };
}

/** The trajectory's figures are named by their method: the name's end tells the unit. */
function trajectory(t: Json): FigureGroup {
  const rows = Object.entries(t ?? {}).map(([name, value]) => namedFigure(name, value as number | null));
  return { title: "The tip's motion", rows };
}

const units: [string, string][] = [
  ["_per_mm", "1/mm"],
  ["_mps2", "m/s²"],
  ["_mps", "m/s"],
  ["_rad", "rad"],
  ["_deg", "°"],
  ["_Hz", "Hz"],
  ["_N", "N"],
  ["_s", "s"],
  ["_m", "m"],
];

export function namedFigure(name: string, value: number | null): FigureRow {
  const [ending, unit] = units.find(([end]) => name.endsWith(end)) ?? ["", ""];
  const words = name.slice(0, name.length - ending.length).replaceAll("_", " ");
  const label = words.charAt(0).toUpperCase() + words.slice(1);
  if (unit === "m" && value != null && Math.abs(value) < 1e-2) return { label, value, ...um };
  if (unit === "s" && value != null && Math.abs(value) < 1e-1) return { label, value, unit: "ms", factor: 1e3 };
  return { label, value, unit };
}

/** Counts are shown whole. */
const count = (value: number | null | undefined): string | null => (value == null ? null : String(value));

/** A figure as text, for tables. */
export function shownFigure({ value, error, unit = "", factor = 1 }: FigureRow): string {
  if (typeof value === "string") return value;
  if (error != null) return withError(value == null ? null : value * factor, error * factor, unit);
  return quantity(value == null ? null : value * factor, unit);
}
