import { useState } from "preact/hooks";
import { Field } from "./Field";

export interface TextFieldProps {
  label: string;
  value: string;
  /** Called on Enter and on leaving the field, if the text is another. */
  onChange(value: string): void;
  /** Called at each key, too. */
  onInput?(value: string): void;
  placeholder?: string;
  hint?: string;
  error?: string;
  disabled?: boolean;
  /** The field below its label. */
  wide?: boolean;
  testId?: string;
}

/** A line of text. */
export function TextField({ label, value, onChange, onInput, placeholder, hint, error, disabled, wide, testId }: TextFieldProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const take = () => {
    if (typed !== null && typed !== value) onChange(typed);
    setTyped(null);
  };
  return (
    <Field
      label={label}
      hint={hint}
      error={error}
      wide={wide}
      control={({ id, describedBy }) => (
        <input
          id={id}
          type="text"
          autocomplete="off"
          spellcheck={false}
          value={typed ?? value}
          placeholder={placeholder}
          disabled={disabled}
          aria-describedby={describedBy}
          data-testid={testId}
          onInput={(event) => {
            setTyped(event.currentTarget.value);
            onInput?.(event.currentTarget.value);
          }}
          onBlur={take}
          onKeyDown={(event) => {
            if (event.key === "Enter") take();
            else if (event.key === "Escape") setTyped(null);
          }}
        />
      )}
    />
  );
}
