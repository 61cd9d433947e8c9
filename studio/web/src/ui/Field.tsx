import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";

/** A control below its label, with its purpose and its error. */
export function Field(props: {
  label: string;
  hint?: string;
  error?: string;
  wide?: boolean;
  control(ids: { id: string; describedBy: string | undefined }): ComponentChildren;
}) {
  const id = useId();
  const { label, hint, error, control } = props;
  const about = error || hint;
  return (
    <div class={props.wide ? "field field-wide" : "field"}>
      <label for={id}>{label}</label>
      <div class="field-control">{control({ id, describedBy: about ? `${id}-about` : undefined })}</div>
      {about && (
        <p id={`${id}-about`} class={error ? "field-error" : "field-hint"}>
          {about}
        </p>
      )}
    </div>
  );
}
