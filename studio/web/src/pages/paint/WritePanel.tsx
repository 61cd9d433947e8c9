import { useState } from "preact/hooks";
import { go } from "../../app/go";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { readEntries } from "../../ui/entries";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { TextField } from "../../ui/TextField";
import { say } from "../../ui/toast";
import { Toggle } from "../../ui/Toggle";
import { Warning } from "../../ui/Warning";
import { chooseScene } from "../feel/feelChoices";
import { kWarpLimit, type PaintSection, type StrokeFigures } from "./painting";

const FORMATS = [
  { value: "gltf", label: "glTF (.glb)" },
  { value: "usda", label: "USDA with displacement" },
  { value: "obj", label: "OBJ with MTL and maps" },
  { value: "stl", label: "STL relief to print" },
  { value: "png", label: "PNG height and normal maps" },
  { value: "wav", label: "WAV of a stroke" },
  { value: "ahap", label: "AHAP of a stroke" },
  { value: "haps", label: ".haps of a stroke" },
  { value: "hjif", label: "HJIF (ISO/IEC 23090-31)" },
  { value: "hmpg", label: "HMPG, the binary form of HJIF" },
  { value: "x3p", label: "X3P heights" },
];

/** What came of the strokes, and where it goes. */
export function WritePanel({ paint, figures }: { paint: PaintSection; figures: StrokeFigures[] }) {
  const [name, setName] = useState("painted");
  const [format, setFormat] = useState("gltf");
  const [replace, setReplace] = useState(false);
  const { written } = paint;

  const nothing = paint.strokes.length === 0 && Object.keys(paint.swaps).length === 0;
  const write = async () => {
    const { scene } = await call("paint.write", { name, replace });
    setReplace(false);
    await edit("/paint/written", scene, `write ${scene}`);
    await readEntries();
  };
  const feel = async () => {
    await chooseScene(written);
    go("feel");
  };
  const exportTo = async () => {
    const { folder, files } = await call("paint.export", { source: written, format, name: `${written.split("/")[0]}-${format}`, replace });
    await readEntries();
    say(`Exported: ${folder}, ${files.length} ${files.length === 1 ? "file" : "files"}`);
  };

  return (
    <>
      {figures.map((one, index) => (one.warp ? <StrokeResult key={index} number={index + 1} figures={one} /> : null))}
      <Panel title="Write">
        <TextField label="Folder" value={name} onChange={setName} testId="paint-name" />
        <Toggle label="Replace an existing folder" on={replace} onChange={setReplace} testId="paint-replace" />
        <Button kind="primary" onClick={write} disabled={nothing} hint={nothing ? "Paint a stroke or swap a texture first." : undefined} testId="paint-write">
          Write scene
        </Button>
        {written && (
          <>
            <Button onClick={feel}>Open in Feel</Button>
            <Select label="Export as" value={format} options={FORMATS} wide onChange={setFormat} testId="paint-format" />
            <Button onClick={exportTo} testId="paint-export">
              Export
            </Button>
          </>
        )}
        <p class="field-hint" role="status" data-testid="paint-written">
          {written && `Written to ${written}`}
        </p>
      </Panel>
    </>
  );
}

function StrokeResult({ number, figures }: { number: number; figures: StrokeFigures }) {
  const warp = figures.warp!;
  return (
    <Panel title={`Result of stroke ${number}`} testId={`paint-result-${number}`}>
      <Figures>
        <Figure label="Length over the surface" value={figures.path_length_m} factor={1e3} unit="mm" />
        <Figure label="Triangles" value={String(figures.triangles)} />
        <Figure label="Length distortion, RMS" value={warp.stretch_rms} factor={100} unit="%" digits={2} hint="Deviation of the singular values from 1, weighted by area" />
        <Figure label="Largest compression" value={warp.stretch_min} digits={3} hint="Smallest singular value; 1 preserves lengths" />
        <Figure label="Largest stretch" value={warp.stretch_max} digits={3} hint="Largest singular value; 1 preserves lengths" />
        <Figure label={`Beyond ${kWarpLimit} times`} value={`${warp.stretched} triangles`} />
        <Figure label="Folded over" value={`${warp.folded} triangles`} />
        <Figure label="Overlapping" value={`${warp.overlapping} triangles`} />
        <Figure label="Distance of points from the mesh, maximum" value={Math.max(...(figures.pick_distance_m ?? [0]))} factor={1e3} unit="mm" digits={2} />
      </Figures>
      {(figures.problems ?? []).map((problem) => (
        <Warning key={problem.message} words={problem.message.replace(/^path \d+: /, "")} />
      ))}
    </Panel>
  );
}
