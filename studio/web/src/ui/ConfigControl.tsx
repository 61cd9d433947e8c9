import { useState } from "preact/hooks";
import { fieldName, type ConfigField } from "./configFields";
import { NumberField } from "./NumberField";
import { parseNumber } from "./numbers";
import { Select } from "./Select";
import { TextField } from "./TextField";
import { Toggle } from "./Toggle";

/** The control of one config field. */
export function ConfigControl({ field, onChange }: { field: ConfigField; onChange(valueText: string): void }) {
  const { label, unit } = fieldName(field.path);
  const hint = field.description;
  switch (field.type) {
    case "bool":
      return <Toggle label={label} on={field.value === true} hint={hint} onChange={(on) => onChange(String(on))} />;
    case "choice":
      return <Select label={label} value={String(field.value)} options={field.choices ?? []} hint={hint} onChange={onChange} />;
    case "integer":
    case "number":
      return (
        <NumberField
          label={label}
          value={Number(field.value)}
          low={field.low ?? undefined}
          high={field.high ?? undefined}
          integer={field.type === "integer"}
          unit={unit}
          hint={hint}
          onChange={(value) => onChange(String(value))}
        />
      );
    case "numbers":
      return <NumbersControl field={field} onChange={onChange} />;
    case "text":
      return <TextField label={label} value={String(field.value)} hint={hint} onChange={onChange} />;
  }
}

function NumbersControl({ field, onChange }: { field: ConfigField; onChange(valueText: string): void }) {
  const [problem, setProblem] = useState("");
  const { label, unit } = fieldName(field.path);
  const numbers = field.value as number[];
  const take = (text: string) => {
    const typed = text.split(/[\s,;[\]]+/).filter(Boolean).map(parseNumber);
    if (typed.includes(null)) return setProblem("Numbers, separated by spaces or commas.");
    setProblem("");
    onChange(`[${typed.join(",")}]`);
  };
  return (
    <TextField
      label={unit ? `${label} (${unit})` : label}
      value={numbers.join(", ")}
      error={problem}
      hint={field.description}
      onChange={take}
    />
  );
}
