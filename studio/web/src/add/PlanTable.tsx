import { useEffect, useRef, useState } from "preact/hooks";
import { kMeanings, type PlanFile, type withMeaning } from "./importPlan";

const kShownCells = 3;

export interface PlanTableProps {
  file: PlanFile;
  onChange(column: number, change: Parameters<typeof withMeaning>[2]): void;
}

/** A file's columns, one a row: its first values, what it means, its unit and why it is read so. */
export function PlanTable({ file, onChange }: PlanTableProps) {
  const rate = file.rate_hz > 0 ? ` at ${file.rate_hz} Hz` : "";
  const caption = `${file.file}: ${file.role}${file.preset ? `, ${file.preset}` : ""}, ${file.rows} rows${rate}`;
  return (
    <section aria-label={caption} class="import-table" data-testid="import-table">
      <h3>{caption}</h3>
      <div class="table-frame" role="region" aria-label={caption} tabIndex={0}>
        <table>
          <thead>
            <tr>
              {["Column", "First values", "Meaning", "Unit", "Reason"].map((word) => (
                <th key={word} scope="col">
                  {word}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {file.columns.map(({ number, label, unit }) => {
              const meant = file.map.find((one) => one.number === number);
              const title = `#${number}${label ? ` ${label}` : ""}${unit ? ` [${unit}]` : ""}`;
              return (
                <tr key={number}>
                  <th scope="row">{title}</th>
                  <td class="import-cells">{file.cells.slice(0, kShownCells).map((row) => row[number - 1]).join("  ")}</td>
                  <td>
                    <select aria-label={`Meaning of column ${title}`} value={meant?.meaning ?? ""} onChange={(event) => onChange(number, { meaning: event.currentTarget.value })}>
                      <option value="" selected={!meant}>
                        not used
                      </option>
                      {kMeanings.map(([group, meanings]) => (
                        <optgroup key={group} label={group}>
                          {meanings.map(([meaning, words]) => (
                            <option key={meaning} value={meaning} selected={meant?.meaning === meaning}>
                              {words}
                            </option>
                          ))}
                        </optgroup>
                      ))}
                    </select>
                  </td>
                  <td>
                    {meant && <UnitField label={`Unit of column ${title}`} unit={meant.unit} onChange={(changed) => onChange(number, { unit: changed })} />}
                  </td>
                  <td>{meant ? (meant.negative ? `sign changed; ${meant.why}` : meant.why) : ""}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </section>
  );
}

/** A unit to type. An answer of the server that comes meanwhile does not replace what is being typed. */
function UnitField({ label, unit, onChange }: { label: string; unit: string; onChange(unit: string): void }) {
  const [typed, setTyped] = useState<string | null>(null);
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => {
    if (document.activeElement !== input.current) setTyped(null);
  }, [unit]);
  return (
    <input
      ref={input}
      type="text"
      class="import-unit"
      aria-label={label}
      value={typed ?? unit}
      spellcheck={false}
      onInput={(event) => setTyped(event.currentTarget.value)}
      onChange={(event) => onChange(event.currentTarget.value.trim())}
    />
  );
}
