import { Field } from "./Field";

export interface Option {
  value: string;
  label: string;
  disabled?: boolean;
}

export interface SelectProps {
  label: string;
  value: string;
  options: readonly (Option | string)[];
  onChange(value: string): void;
  hint?: string;
  disabled?: boolean;
  /** The choice below its label. */
  wide?: boolean;
  testId?: string;
}

/** One of some choices. */
export function Select({ label, value, options, onChange, hint, disabled, wide, testId }: SelectProps) {
  const all = options.map((option) => (typeof option === "string" ? { value: option, label: option } : option));
  return (
    <Field
      label={label}
      hint={hint}
      wide={wide}
      control={({ id, describedBy }) => (
        <select
          id={id}
          value={value}
          disabled={disabled}
          aria-describedby={describedBy}
          data-testid={testId}
          onChange={(event) => onChange(event.currentTarget.value)}
        >
          {all.map((option) => (
            <option key={option.value} value={option.value} disabled={option.disabled} selected={option.value === value}>
              {option.label}
            </option>
          ))}
        </select>
      )}
    />
  );
}
