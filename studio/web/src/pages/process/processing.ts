// What the Process page keeps in the document, and what its forms make of it.
import type { ConfigField } from "../../ui/configFields";
import { length } from "../../ui/format";

export interface ScanName {
  recording: string;
  segment: string;
}

export interface MergeSection {
  /** Recordings, and results whose noise was not removed. */
  strokes: string[];
  /** Settings `align.*` that are not the defaults, as text. */
  config: Record<string, string>;
}

export interface ProcessSection {
  scans: ScanName[];
  current: number;
  /** Settings that are not the defaults, as text: what `--set` takes. */
  config: Record<string, string>;
  /** Missing in what an older studio has kept. */
  merge?: MergeSection;
}

/** The fields with the document's settings in them. */
export function withConfig(defaults: readonly ConfigField[], config: Record<string, string>): ConfigField[] {
  return defaults.map((field) => {
    const text = config[field.path];
    return { ...field, value: text === undefined ? field.default : parsed(field, text) };
  });
}

function parsed(field: ConfigField, text: string): ConfigField["value"] {
  switch (field.type) {
    case "bool":
      return text === "true";
    case "integer":
    case "number":
      return Number(text);
    case "numbers":
      return JSON.parse(text);
    default:
      return text;
  }
}

export function fieldAt(fields: readonly ConfigField[], path: string): ConfigField | undefined {
  return fields.find((field) => field.path === path);
}

export const scanTitle = (scan: ScanName): string => (scan.segment ? `${scan.recording}, ${scan.segment}` : scan.recording);

export const isSameScan = (a: ScanName, b: ScanName): boolean => a.recording === b.recording && a.segment === b.segment;

/** The index of the selected scan; −1 without a selection. */
export const currentIndex = ({ scans, current }: ProcessSection): number => Math.min(current, scans.length - 1);

/** A section with a recording more, which is looked at; with one that is there already, that one. */
export function withScan(section: ProcessSection, scan: ScanName): ProcessSection {
  const there = section.scans.findIndex((other) => isSameScan(other, scan));
  if (there >= 0) return { ...section, current: there };
  return { ...section, scans: [...section.scans, scan], current: section.scans.length };
}

export function withoutScan(section: ProcessSection, index: number): ProcessSection {
  const scans = section.scans.filter((_, at) => at !== index);
  const current = Math.max(0, Math.min(section.current > index ? section.current - 1 : section.current, scans.length - 1));
  return { ...section, scans, current };
}

/** A control that is in front, next to the form of all settings. */
export interface Knob {
  path: string;
  label: string;
  /** Also of the value. */
  hint: string | ((value: number) => string);
  kind: "slider" | "toggle";
  low: number;
  high: number;
  factor: number;
  unit: string;
  logarithmic?: boolean;
}

const cutoff = (path: string): Knob => ({
  path, label: "High-pass cut-off", hint: cutoffWords, kind: "slider", low: 0.01, high: 2, factor: 1, unit: "cycles/mm", logarithmic: true,
});

/** The cut-off as the wavelength λc that standards state. */
export const cutoffWords = (cycles_per_mm: number): string =>
  cycles_per_mm > 0 ? `λc = ${length(1e-3 / cycles_per_mm, 3)}: longer waves are not part of the texture.` : "No high-pass: all waves are part of the texture.";

/** The settings that are tuned most, by method. */
export function knobs(method: string): Knob[] {
  if (method.startsWith("thesis")) {
    return [
      cutoff("thesis.profile.cutoff_cycles_per_mm"),
      { path: "thesis.profile.scale_by_force", label: "Force compensation", hint: "Compensates for the hand's varying force in the acceleration.", kind: "toggle", low: 0, high: 1, factor: 1, unit: "" },
      { path: "thesis.profile.force_window_s", label: "Averaging time of the force", hint: "Moving average of the force before it is used.", kind: "slider", low: 0, high: 1, factor: 1e3, unit: "ms" },
      { path: "thesis.profile.min_speed_mps", label: "Velocity threshold", hint: "Slower samples become gaps: the tip sticks or is stationary.", kind: "slider", low: 0, high: 0.05, factor: 1e3, unit: "mm/s" },
    ];
  }
  return [
    cutoff("profile.cutoff_cycles_per_mm"),
    { path: "base.contact.touch_N", label: "Contact threshold", hint: "Below it the tip is off the surface.", kind: "slider", low: 0.051, high: 2, factor: 1, unit: "N", logarithmic: true },
    { path: "profile.max_stop_s", label: "Longest static interval", hint: "A longer static interval splits the profile.", kind: "slider", low: 0.05, high: 10, factor: 1, unit: "s", logarithmic: true },
    { path: "compliance.min_speed_mps", label: "Velocity threshold", hint: "Slower windows do not count for the compliance.", kind: "slider", low: 0.001, high: 0.05, factor: 1e3, unit: "mm/s" },
  ];
}
