import { attempt } from "./Button";
import { classes } from "./classes";
import { Icon, type IconName } from "./Icon";

export interface IconButtonProps {
  icon: IconName;
  /** What it does, in words; also its tooltip. */
  label: string;
  onClick(): unknown;
  disabled?: boolean;
  pressed?: boolean;
  testId?: string;
}

/** A button with a picture only; its words are its name and tooltip. */
export function IconButton({ icon, label, onClick, disabled, pressed, testId }: IconButtonProps) {
  return (
    <button
      type="button"
      class={classes("button", "button-icon")}
      disabled={disabled}
      title={label}
      aria-label={label}
      aria-pressed={pressed}
      data-testid={testId}
      onClick={() => attempt(onClick)}
    >
      <Icon name={icon} />
    </button>
  );
}
