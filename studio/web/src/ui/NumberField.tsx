import { useState } from "preact/hooks";
import { Field } from "./Field";
import { NumberInput } from "./NumberInput";

export interface NumberFieldProps {
  label: string;
  value: number;
  onChange(value: number): void;
  /** Limits and step are in the unit of `value`; what is shown is value × factor, in `unit`. */
  low?: number;
  high?: number;
  step?: number;
  factor?: number;
  unit?: string;
  integer?: boolean;
  hint?: string;
  disabled?: boolean;
  testId?: string;
}

/** A number that is typed or stepped with the arrow keys (Shift: tenfold). */
export function NumberField({ label, hint, unit, ...input }: NumberFieldProps) {
  const [problem, setProblem] = useState("");
  return (
    <Field
      label={label}
      hint={hint}
      error={problem}
      control={({ id, describedBy }) => (
        <>
          <NumberInput id={id} describedBy={describedBy} onProblem={setProblem} {...input} />
          {unit && <span class="unit">{unit}</span>}
        </>
      )}
    />
  );
}
