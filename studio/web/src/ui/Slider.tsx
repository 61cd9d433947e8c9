import { useRef, useState } from "preact/hooks";
import { newGesture } from "../state/document";
import { Field } from "./Field";
import { NumberInput } from "./NumberInput";

export interface SliderProps {
  label: string;
  value: number;
  low: number;
  high: number;
  /** Step of the slider in the unit of `value`; a hundredth of the range without it. */
  step?: number;
  /** What is shown is value × factor, in `unit`. */
  factor?: number;
  unit?: string;
  /** Equal ways on the slider are equal ratios; needs low > 0. */
  logarithmic?: boolean;
  hint?: string;
  disabled?: boolean;
  testId?: string;
  /** Hand `gesture` to edit(): a whole drag is then one step for undo. */
  onInput(value: number, gesture: string): void;
}

const kPositions = 1000;
const kPause_ms = 1000;

/** A slider with a number field next to it, for the same value. */
export function Slider(props: SliderProps) {
  const { label, value, low, high, unit, hint, logarithmic = false, onInput } = props;
  const [problem, setProblem] = useState("");
  const gesture = useRef({ name: "", last_ms: -Infinity });
  const step = props.step ?? (high - low) / 100;

  const position = logarithmic ? (kPositions * Math.log(value / low)) / Math.log(high / low) : value;
  const valueAt = (at: number) => (logarithmic ? Number((low * (high / low) ** (at / kPositions)).toPrecision(4)) : at);
  const begin = () => (gesture.current.name = newGesture());
  const goOn = () => {
    const now_ms = performance.now();
    if (!gesture.current.name || now_ms - gesture.current.last_ms > kPause_ms) begin();
    gesture.current.last_ms = now_ms;
    return gesture.current.name;
  };

  return (
    <Field
      label={label}
      hint={hint}
      error={problem}
      wide
      control={({ id, describedBy }) => (
        <>
          <input
            type="range"
            id={id}
            min={logarithmic ? 0 : low}
            max={logarithmic ? kPositions : high}
            step={logarithmic ? 1 : step}
            value={position}
            disabled={props.disabled}
            aria-describedby={describedBy}
            aria-valuetext={`${Number((value * (props.factor ?? 1)).toPrecision(4))} ${unit ?? ""}`.trim()}
            data-testid={props.testId}
            onPointerDown={begin}
            onInput={(event) => onInput(valueAt(Number(event.currentTarget.value)), goOn())}
          />
          <NumberInput
            label={`${label}, as a number`}
            value={value}
            low={low}
            high={high}
            step={step}
            factor={props.factor}
            disabled={props.disabled}
            onProblem={setProblem}
            onChange={(next) => onInput(next, goOn())}
          />
          {unit && <span class="unit">{unit}</span>}
        </>
      )}
    />
  );
}
