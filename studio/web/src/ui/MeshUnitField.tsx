import { useEffect, useState } from "preact/hooks";
import { project } from "../state/project";
import { meshUnits, textOfLength, unitOfLength, unitInForce, unitOfText, unitShort } from "./meshUnits";
import { NumberField } from "./NumberField";
import { Select } from "./Select";

export interface MeshUnitFieldProps {
  /** As text: "mm", "0.06m"; "": as the file states, or the project's. */
  value: string;
  onChange(value: string): void;
  label?: string;
  /** The mesh whose unit this is; without it a unit must be chosen. */
  file?: string;
  disabled?: boolean;
  testId?: string;
}

const OTHER = "other";
const kLeast_m = 1e-9;
const kMost_m = 1e3;

/** What one unit of a mesh file is: the file's or the project's, one of the usual ones, or any length. */
export function MeshUnitField({ value, onChange, label = "Mesh unit", file, disabled, testId }: MeshUnitFieldProps) {
  const unit_m = unitOfText(unitInForce(file ?? "", value, project.value.mesh_unit)) ?? 1;
  const known = value === "" ? null : unitOfLength(unit_m);
  const [typing, setTyping] = useState(false);
  useEffect(() => setTyping(false), [file]);
  const isOther = typing || (value !== "" && !known);
  const first = file === undefined ? [] : [{ value: "", label: unstated(file) }];
  return (
    <>
      <Select
        label={label}
        value={isOther ? OTHER : (known?.text ?? "")}
        options={[...first, ...meshUnits.map(({ text, label: words }) => ({ value: text, label: words })), { value: OTHER, label: "Another length …" }]}
        disabled={disabled}
        testId={testId}
        onChange={(text) => {
          setTyping(text === OTHER);
          if (text !== OTHER) onChange(text);
        }}
      />
      {isOther && (
        <NumberField label="One unit is" value={unit_m} factor={1e3} unit="mm" low={kLeast_m} high={kMost_m} disabled={disabled} onChange={(length_m) => onChange(textOfLength(length_m))} testId={testId && `${testId}-length`} />
      )}
    </>
  );
}

const unstated = (file: string): string => (/\.(gltf|glb)$/i.test(file) ? "m, file's" : `${unitShort(project.value.mesh_unit) ?? project.value.mesh_unit}, project's`);
