import { useId } from "preact/hooks";

export interface ToggleProps {
  label: string;
  on: boolean;
  onChange(on: boolean): void;
  hint?: string;
  disabled?: boolean;
  testId?: string;
}

/** Something that is on or off. */
export function Toggle({ label, on, onChange, hint, disabled, testId }: ToggleProps) {
  const id = useId();
  return (
    <div class="toggle">
      <input
        id={id}
        type="checkbox"
        role="switch"
        checked={on}
        disabled={disabled}
        aria-describedby={hint ? `${id}-about` : undefined}
        data-testid={testId}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      <label for={id}>{label}</label>
      {hint && (
        <p id={`${id}-about`} class="field-hint">
          {hint}
        </p>
      )}
    </div>
  );
}
