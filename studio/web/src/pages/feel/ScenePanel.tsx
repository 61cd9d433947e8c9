import { edit } from "../../state/document";
import { attempt } from "../../ui/Button";
import { entries } from "../../ui/entries";
import { FilePicker } from "../../ui/FilePicker";
import { MeshUnitField } from "../../ui/MeshUnitField";
import { NumberField } from "../../ui/NumberField";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { chooseHeightMaps, chooseScene, feelSection } from "./feelChoices";
import { feelStatus } from "./feelStore";

const kTiles = 4;

/** Object to touch: a scene or a mesh, or images as tiles of a plane. */
export function ScenePanel({ maps, onMaps }: { maps: boolean; onMaps(maps: boolean): void }) {
  const chosen = feelSection.value ?? {};
  const status = feelStatus.value;
  const isMesh = /\.(obj|ply|stl|off|gltf|glb)$/i.test(chosen.scene ?? "");
  return (
    <Panel title="Object to touch" collapsible>
      <Select
        label="Kind"
        wide
        value={maps ? "maps" : "scene"}
        options={[
          { value: "scene", label: "Scene or mesh" },
          { value: "maps", label: "Height maps" },
        ]}
        onChange={(kind) => onMaps(kind === "maps")}
        testId="feel-kind"
      />
      {!maps && (
        <FilePicker label="Scene" kinds={["scene", "mesh"]} value={chosen.scene ?? ""} none="None" onChange={(name) => attempt(() => chooseScene(name))} testId="feel-scene" />
      )}
      {!maps && isMesh && (
        <MeshUnitField
          value={chosen.mesh_unit ?? ""}
          file={chosen.scene}
          onChange={(unit) => void attempt(() => edit("/feel/mesh_unit", unit, "change the mesh's unit"))}
          testId="feel-unit"
        />
      )}
      {maps && <Tiles />}
      {status?.problem && (
        <p class="feel-problem" role="alert" data-testid="feel-problem">
          {status.problem}. {status.hint}
        </p>
      )}
    </Panel>
  );
}

/** Up to four images, upper left first (thesis Fig. 38). */
function Tiles() {
  const chosen = feelSection.value ?? {};
  const names = chosen.height_maps ?? [];
  const images = entries.value.filter((entry) => entry.kind === "image");
  const set = (at: number, name: string) => {
    const next = [...names];
    if (name) next[Math.min(at, next.length)] = name;
    else next.splice(at, 1);
    return attempt(() => chooseHeightMaps(next));
  };
  if (images.length === 0 && names.length === 0) {
    return <p class="empty">No PNG or PGM images in the folder. Export a texture as an image, or copy images into it.</p>;
  }
  return (
    <>
      {Array.from({ length: Math.min(16, Math.max(kTiles, names.length)) }, (_, at) => (
        <FilePicker key={at} label={`Tile ${at + 1}`} kinds={["image"]} value={names[at] ?? ""} none="None" disabled={at > names.length} onChange={(name) => set(at, name)} testId={`feel-tile-${at + 1}`} />
      ))}
      <NumberField label="Side of a tile" unit="mm" value={chosen.tile_mm ?? 10} low={0.001} high={10000} onChange={(value) => attempt(() => edit("/feel/tile_mm", value, "side of a tile"))} />
      <NumberField label="Black to white" unit="mm" value={chosen.range_mm ?? 2.5} low={1e-6} high={1000} onChange={(value) => attempt(() => edit("/feel/range_mm", value, "height range"))} />
    </>
  );
}
