import { useEffect, useState } from "preact/hooks";
import { call } from "../net/connection";
import { saveFile } from "../save/files";
import { Button } from "../ui/Button";
import { Dialog } from "../ui/Dialog";
import { readEntries } from "../ui/entries";
import { NumberField } from "../ui/NumberField";
import { Table } from "../ui/Table";
import { TextField } from "../ui/TextField";
import { say } from "../ui/toast";

interface Parameter {
  key: string;
  value: string;
  unit: string;
}

interface Look {
  kind: "profile" | "map";
  points: number;
  missing: number;
  size: string;
  /** A PNG, base64; "" without one. */
  picture: string;
  note: string;
  parameters: Parameter[];
}

/** The name of a texture of a file: its own without the ending. */
export const textureName = (file: string): string => `${file.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}.texture.json`;

const pngOf = (base64: string): Blob => new Blob([Uint8Array.from(atob(base64), (byte) => byte.charCodeAt(0))], { type: "image/png" });

/** A file of heights: its picture, its roughness, and a texture of it. */
export function SurfaceDialog({ file, onClose }: { file: string; onClose(): void }) {
  const [spacing_mm, setSpacing] = useState(0);
  const [look, setLook] = useState<Look | null>(null);
  const [fault, setFault] = useState("");
  const [name, setName] = useState(textureName(file));
  useEffect(() => {
    let wanted = true;
    setFault("");
    call<Look>("surface.look", { file, spacing_mm })
      .then((found) => wanted && setLook(found))
      .catch((error: unknown) => {
        if (!wanted) return;
        setLook(null);
        setFault(error instanceof Error ? error.message : String(error));
      });
    return () => void (wanted = false);
  }, [file, spacing_mm]);
  const fit = async () => {
    await call("surface.texture", { file, spacing_mm, name });
    await readEntries();
    say(`${name} is in the project.`, "Paint it onto a mesh on the page Paint.");
  };
  return (
    <Dialog
      open
      wide
      title={file}
      onClose={onClose}
      actions={
        <>
          <TextField label="Name of the texture" value={name} onChange={setName} testId="surface-name" />
          <Button kind="primary" disabled={!look} onClick={fit} testId="surface-texture">
            Make a texture
          </Button>
        </>
      }
    >
      {fault && (
        <p class="empty" role="alert">
          {fault}
        </p>
      )}
      {!look && !fault && <p role="status">Reading the heights …</p>}
      {(fault || spacing_mm > 0) && (
        <NumberField label="Distance of the heights" unit="mm" value={spacing_mm} low={0} high={1000} step={0.001} onChange={setSpacing} testId="surface-spacing" />
      )}
      {look && (
        <>
          <p data-testid="surface-size">
            {look.kind === "map" ? "Areal map" : "Profile"}, {look.size}
            {look.missing > 0 ? `; ${look.missing} of ${look.points} heights are missing` : ""}
          </p>
          {look.note && <p class="empty">{look.note}</p>}
          {look.picture && (
            <figure class="surface-picture">
              <img src={`data:image/png;base64,${look.picture}`} alt={`Heights of ${file}`} data-testid="surface-picture" />
              <figcaption>
                <Button kind="quiet" onClick={() => saveFile(textureName(file).replace(".texture.json", ".png"), pngOf(look.picture), "image/png")}>
                  Save the picture
                </Button>
              </figcaption>
            </figure>
          )}
          <Table
            caption={`Roughness of ${file}`}
            columns={[
              { key: "key", label: "Parameter" },
              { key: "value", label: "Value", numeric: true, cell: (row: Parameter) => row.value || "not determined" },
              { key: "unit", label: "Unit" },
            ]}
            rows={look.parameters}
            rowKey={(row) => row.key}
            savable
            testId="surface-parameters"
          />
        </>
      )}
    </Dialog>
  );
}
