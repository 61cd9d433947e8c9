import type { ComponentChildren } from "preact";
import { classes } from "./classes";
import { complain } from "./toast";

export interface ButtonProps {
  children: ComponentChildren;
  /** May return a promise: what it rejects with is shown, and the button is busy until then. */
  onClick(): unknown;
  kind?: "plain" | "primary" | "danger" | "quiet";
  disabled?: boolean;
  /** Why it is disabled, or what it does beyond its words. */
  hint?: string;
  pressed?: boolean;
  testId?: string;
  label?: string;
}

/** A button with words. Errors of its action are shown to the user. */
export function Button({ children, onClick, kind = "plain", disabled, hint, pressed, testId, label }: ButtonProps) {
  return (
    <button
      type="button"
      class={classes("button", `button-${kind}`)}
      disabled={disabled}
      title={hint}
      aria-label={label}
      aria-pressed={pressed}
      data-testid={testId}
      onClick={() => attempt(onClick)}
    >
      {children}
    </button>
  );
}

/** Runs an action; what it throws or rejects with is shown to the user. */
export async function attempt(action: () => unknown): Promise<void> {
  try {
    await action();
  } catch (error) {
    complain(error);
  }
}
