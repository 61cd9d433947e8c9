import { edit } from "../../state/document";
import { ConfigForm } from "../../ui/ConfigForm";
import type { ConfigField } from "../../ui/configFields";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import { complain } from "../../ui/toast";
import { Toggle } from "../../ui/Toggle";
import { fieldAt, knobs, type Knob } from "./processing";

const METHODS = [
  { value: "fused", label: "Fused: both sensors at once" },
  { value: "thesis", label: "Thesis: the baseline" },
  { value: "thesis_tuned", label: "Thesis, tuned by likelihood" },
  { value: "raw", label: "Raw: the tracker's poses" },
  { value: "ekf", label: "EKF: one pass, causal" },
  { value: "particle", label: "Particle filter, causal" },
];

/** Sets a field of the config; null: back to its default. */
export const set = (path: string, text: string | null, gesture = "") =>
  edit(`/process/config/${path}`, text, text === null ? `reset ${path}` : `set ${path}`, gesture).catch(complain);

/** The settings: those that are tuned most, and all of them. */
export function TuningPanel({ fields }: { fields: readonly ConfigField[] }) {
  const method = String(fieldAt(fields, "method")?.value ?? "fused");
  return (
    <>
      <Panel title="Tune" testId="tune">
        <Select label="Method" wide value={method} options={METHODS} onChange={(value) => set("method", value)} testId="method" />
        {knobs(method).map((knob) => (
          <KnobControl key={knob.path} knob={knob} field={fieldAt(fields, knob.path)} />
        ))}
      </Panel>
      <Panel title="All settings" collapsible open={false} testId="all-settings">
        <ConfigForm fields={fields} onChange={(path, text) => set(path, text)} />
      </Panel>
    </>
  );
}

function KnobControl({ knob, field }: { knob: Knob; field: ConfigField | undefined }) {
  if (!field) return null;
  const hint = typeof knob.hint === "string" ? knob.hint : knob.hint(Number(field.value));
  if (knob.kind === "toggle") {
    return <Toggle label={knob.label} on={field.value === true} hint={hint} onChange={(on) => set(knob.path, String(on))} testId={knob.path} />;
  }
  return (
    <Slider
      label={knob.label}
      hint={hint}
      value={Number(field.value)}
      low={knob.low}
      high={knob.high}
      factor={knob.factor}
      unit={knob.unit}
      logarithmic={knob.logarithmic}
      testId={knob.path}
      onInput={(value, gesture) => set(knob.path, String(Number(value.toPrecision(6))), gesture)}
    />
  );
}
