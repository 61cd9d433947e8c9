import { useState } from "preact/hooks";
import { grouped, isChanged, type ConfigField } from "./configFields";
import { ConfigControl } from "./ConfigControl";
import { IconButton } from "./IconButton";
import { TextField } from "./TextField";

export type { ConfigField } from "./configFields";

export interface ConfigFormProps {
  fields: readonly ConfigField[];
  /** The value as text, as after `--set path=`; null: back to the default. */
  onChange(path: string, valueText: string | null): void;
  disabled?: boolean;
}

/** All fields of a config, grouped by what is before the last dot of the path; with a search. */
export function ConfigForm({ fields, onChange, disabled }: ConfigFormProps) {
  const [search, setSearch] = useState("");
  const [changedOnly, setChangedOnly] = useState(false);
  const changed = fields.filter(isChanged).length;
  const groups = grouped(fields, search, changedOnly);
  return (
    <div class="config">
      <div class="config-search">
        <TextField label="Search the settings" wide value={search} onInput={setSearch} onChange={setSearch} />
        <label class="config-changed">
          <input type="checkbox" checked={changedOnly} onChange={(event) => setChangedOnly(event.currentTarget.checked)} />
          Changed only ({changed})
        </label>
      </div>
      {groups.length === 0 && <p class="empty">No setting has this text in its name or description.</p>}
      {groups.map((group) => (
        <fieldset key={group.name} class="config-group" disabled={disabled}>
          <legend>{group.name}</legend>
          {group.fields.map((field) => (
            <div key={field.path} class={isChanged(field) ? "config-field config-field-changed" : "config-field"}>
              <ConfigControl field={field} onChange={(text) => onChange(field.path, text)} />
              {isChanged(field) && (
                <IconButton icon="reset" label={`Reset ${field.path} to its default`} onClick={() => onChange(field.path, null)} />
              )}
            </div>
          ))}
        </fieldset>
      ))}
    </div>
  );
}
