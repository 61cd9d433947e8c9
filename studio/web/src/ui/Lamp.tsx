export type LampState = "off" | "good" | "warn" | "bad" | "busy";

export interface LampProps {
  state: LampState;
  /** The state in a word or two, always shown: "in contact". */
  word: string;
  /** The thing whose state it is; read out before the word. */
  label?: string;
  /** Changes are read out. */
  live?: boolean;
  testId?: string;
}

const SHAPES: Record<LampState, string> = {
  off: "M8 3.500a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9z",
  good: "M8 3.500a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9z",
  warn: "M8 2.5 14 13H2z",
  bad: "M5.5 2.500h5l3 3v5l-3 3h-5l-3-3v-5z",
  busy: "M8 2.5 13.5 8 8 13.5 2.5 8z",
};

/** A state by shape, colour and word. */
export function Lamp({ state, word, label, live, testId }: LampProps) {
  return (
    <span class={`lamp lamp-${state}`} role={live ? "status" : undefined} data-testid={testId} data-state={state}>
      <svg viewBox="0 0 16 16" width="14" height="14" aria-hidden="true" focusable="false">
        <path d={SHAPES[state]} />
      </svg>
      {label && <span class="lamp-label">{label} </span>}
      <span class="lamp-word">{word}</span>
    </span>
  );
}
