// Fields of a config as the server describes them, and how a form shows them.

export interface ConfigField {
  /** Dotted: "trajectory.cutoff_Hz". */
  path: string;
  type: "bool" | "integer" | "number" | "text" | "choice" | "numbers";
  value: boolean | number | string | number[];
  default: boolean | number | string | number[];
  description?: string;
  low?: number | null;
  high?: number | null;
  choices?: string[];
}

export interface ConfigGroup {
  name: string;
  fields: ConfigField[];
}

export const isChanged = (field: ConfigField): boolean => JSON.stringify(field.value) !== JSON.stringify(field.default);

/** Fields whose path or description has all words of `search`, by the path before its last dot, in their order. */
export function grouped(fields: readonly ConfigField[], search: string, changedOnly: boolean): ConfigGroup[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const groups = new Map<string, ConfigField[]>();
  for (const field of fields) {
    if (changedOnly && !isChanged(field)) continue;
    const text = `${field.path} ${field.description ?? ""}`.toLowerCase();
    if (!words.every((word) => text.includes(word))) continue;
    const name = field.path.includes(".") ? field.path.slice(0, field.path.lastIndexOf(".")) : "general";
    groups.set(name, [...(groups.get(name) ?? []), field]);
  }
  return [...groups].map(([name, members]) => ({ name, fields: members }));
}

const UNITS: [suffix: string, unit: string][] = [
  ["_N_per_m", "N/m"],
  ["_m_s2", "m/s²"],
  ["_m_s", "m/s"],
  ["_mps", "m/s"],
  ["_rad_s", "rad/s"],
  ["_Hz", "Hz"],
  ["_hz", "Hz"],
  ["_deg", "°"],
  ["_rad", "rad"],
  ["_mm", "mm"],
  ["_um", "µm"],
  ["_ms", "ms"],
  ["_ns", "ns"],
  ["_us", "µs"],
  ["_kg", "kg"],
  ["_px", "px"],
  ["_N", "N"],
  ["_m", "m"],
  ["_s", "s"],
];

/** The words and the unit of a path's last part: "cutoff_Hz" gives "cutoff" and "Hz". */
export function fieldName(path: string): { label: string; unit: string } {
  const last = path.slice(path.lastIndexOf(".") + 1);
  const found = UNITS.find(([suffix]) => last.endsWith(suffix) && last.length > suffix.length);
  const bare = found ? last.slice(0, -found[0].length) : last;
  const words = bare.replaceAll("_", " ");
  return { label: words.charAt(0).toUpperCase() + words.slice(1), unit: found ? found[1] : "" };
}
