// The scan's settings: what the document holds of them, and the fields that the server knows.
import { edit, section } from "../../state/document";
import type { ConfigField } from "../../ui/ConfigForm";

export interface ScanSection {
  source: "bench" | "hardware" | "replay";
  hardware: {
    probe: string;
    protocol: string;
    camera: string;
    markers: string;
    poses: string;
    calibration: string;
    uncalibrated: boolean;
    world: string;
  };
  recording: string;
  segment: string;
  object: string;
  name: string;
  auto: boolean;
  settings: Record<string, string>;
}

export const scan = section<ScanSection>("scan");

/** A setting's text as a value: TOML's numbers, truth values and texts are JSON's; a bare word is a text. */
export function valueOf(text: string): ConfigField["value"] {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

/** The fields with the values that the document gives them. */
export const withSettings = (fields: readonly ConfigField[], settings: Record<string, string>): ConfigField[] =>
  fields.map((field) => {
    const text = settings[field.path];
    return text === undefined ? { ...field, value: field.default } : { ...field, value: valueOf(text) };
  });

/** The settings with some changed; null takes one out: back to its default. */
export function changed(settings: Record<string, string>, changes: Record<string, string | null>): Record<string, string> {
  const out = { ...settings };
  for (const [path, text] of Object.entries(changes)) {
    if (text === null) delete out[path];
    else out[path] = text;
  }
  return out;
}

/** Changes settings as one edit. */
export const setSettings = (changes: Record<string, string | null>, label: string, gesture = ""): Promise<void> =>
  edit("/scan/settings", changed(scan.value.settings, changes), label, gesture);

/** What takes effect only when the source is opened again. */
export const waitsForOpening = (path: string): boolean => /^(recorder|track|bench)\./.test(path);

/** Those of the processing, by their paths there. */
export const processSettings = (settings: Record<string, string>): Record<string, string> =>
  Object.fromEntries(Object.entries(settings).flatMap(([path, text]) => (path.startsWith("process.") ? [[path.slice("process.".length), text]] : [])));
