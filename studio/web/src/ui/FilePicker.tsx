import { entries, type EntryKind } from "./entries";
import { Select } from "./Select";

export interface FilePickerProps {
  label: string;
  kinds: readonly EntryKind[];
  /** Name relative to the project's folder; "": none. */
  value: string;
  onChange(name: string): void;
  /** Words for "none"; without them one must be chosen. */
  none?: string;
  hint?: string;
  disabled?: boolean;
  testId?: string;
}

/** One of the project's files. */
export function FilePicker({ label, kinds, value, onChange, none, hint, disabled, testId }: FilePickerProps) {
  const names = entries.value.filter((entry) => kinds.includes(entry.kind)).map((entry) => entry.name);
  const missing = value !== "" && !names.includes(value);
  const first = { value: "", label: none ?? (names.length ? "Choose …" : "None in the folder"), disabled: none === undefined };
  const gone = missing ? [{ value, label: `${value} (not in the folder)` }] : [];
  return (
    <Select
      label={label}
      value={value}
      options={[first, ...gone, ...names]}
      onChange={onChange}
      hint={hint}
      disabled={disabled}
      wide
      testId={testId}
    />
  );
}
