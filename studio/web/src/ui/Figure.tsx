import { quantity, withError } from "./format";

export interface FigureProps {
  label: string;
  /** A number is shown as value × factor with `digits` significant digits; text as it is; null as a dash. */
  value: number | string | null | undefined;
  /** Standard uncertainty, in the unit of `value`. */
  error?: number | null;
  unit?: string;
  factor?: number;
  digits?: number;
  hint?: string;
  testId?: string;
}

/** A result: label, value ± error, unit. Several of them are in a <Figures>. */
export function Figure({ label, value, error, unit = "", factor = 1, digits = 4, hint, testId }: FigureProps) {
  const shown =
    typeof value === "string"
      ? value
      : error != null
        ? withError(value == null ? null : value * factor, error * factor, unit)
        : quantity(value == null ? null : value * factor, unit, digits);
  return (
    <div class="figure" title={hint} data-testid={testId}>
      <dt>{label}</dt>
      <dd>{shown}</dd>
    </div>
  );
}
