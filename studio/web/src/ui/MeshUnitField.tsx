import { useState } from "preact/hooks";
import { meshUnits, unitOfLength } from "./meshUnits";
import { NumberField } from "./NumberField";
import { Select } from "./Select";

export interface MeshUnitFieldProps {
  /** Metres of the mesh's unit. */
  unit_m: number;
  onChange(unit_m: number): void;
  disabled?: boolean;
  testId?: string;
}

const OTHER = "other";
const kLeast_m = 1e-9;
const kMost_m = 1e3;

/** What one unit of a mesh file is: one of the usual ones, or any length. */
export function MeshUnitField({ unit_m, onChange, disabled, testId }: MeshUnitFieldProps) {
  const known = unitOfLength(unit_m);
  const [typing, setTyping] = useState(false);
  const isOther = typing || !known;
  return (
    <>
      <Select
        label="Mesh unit"
        value={isOther ? OTHER : known.text}
        options={[...meshUnits.map(({ text, label }) => ({ value: text, label })), { value: OTHER, label: "Another length …" }]}
        disabled={disabled}
        testId={testId}
        onChange={(text) => {
          const chosen = meshUnits.find((one) => one.text === text);
          setTyping(!chosen);
          if (chosen) onChange(chosen.unit_m);
        }}
      />
      {isOther && (
        <NumberField label="One unit is" value={unit_m} factor={1e3} unit="mm" low={kLeast_m} high={kMost_m} disabled={disabled} onChange={onChange} testId={testId && `${testId}-length`} />
      )}
    </>
  );
}
