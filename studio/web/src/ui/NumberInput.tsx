import { useState } from "preact/hooks";
import { parseNumber, shownNumber } from "./numbers";

/** The bare field of NumberField and Slider: text that is taken on Enter, on leaving and on the arrow keys. */
export function NumberInput(props: {
  id?: string;
  label?: string;
  describedBy?: string | undefined;
  value: number;
  low?: number;
  high?: number;
  step?: number;
  factor?: number;
  integer?: boolean;
  disabled?: boolean;
  testId?: string;
  onChange(value: number): void;
  onProblem?(words: string): void;
}) {
  const { value, low = -Infinity, high = Infinity, factor = 1, onChange } = props;
  const [typed, setTyped] = useState<string | null>(null);
  const step = props.step ?? (props.integer ? 1 : Math.max(Math.abs(value) / 10, 1e-3 / factor));
  const tell = (words: string) => props.onProblem?.(words);

  const take = (text: string) => {
    setTyped(null);
    const shown = parseNumber(text);
    if (shown === null) return tell(`“${text}” is not a number.`);
    const next = props.integer ? Math.round(shown / factor) : shown / factor;
    if (next < low || next > high) return tell(`Between ${shownNumber(low * factor)} and ${shownNumber(high * factor)}.`);
    tell("");
    if (next !== value) onChange(next);
  };
  const nudge = (steps: number) => {
    setTyped(null);
    tell("");
    const next = Math.min(high, Math.max(low, Number((value + steps * step).toPrecision(12))));
    if (next !== value) onChange(next);
  };

  return (
    <input
      id={props.id}
      class="number-input"
      type="text"
      inputMode="decimal"
      role="spinbutton"
      autocomplete="off"
      aria-label={props.label}
      aria-describedby={props.describedBy}
      aria-valuenow={value * factor}
      aria-valuemin={Number.isFinite(low) ? low * factor : undefined}
      aria-valuemax={Number.isFinite(high) ? high * factor : undefined}
      value={typed ?? shownNumber(value * factor)}
      disabled={props.disabled}
      data-testid={props.testId}
      onInput={(event) => setTyped(event.currentTarget.value)}
      onBlur={() => typed !== null && take(typed)}
      onKeyDown={(event) => {
        if (event.key === "Enter" && typed !== null) take(typed);
        else if (event.key === "Escape" && typed !== null) setTyped(null);
        else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
          event.preventDefault();
          nudge((event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1));
        }
      }}
    />
  );
}
