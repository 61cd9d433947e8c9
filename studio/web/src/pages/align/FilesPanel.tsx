import { useEffect, useState } from "preact/hooks";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { entries } from "../../ui/entries";
import { FilePicker } from "../../ui/FilePicker";
import { MeshUnitField } from "../../ui/MeshUnitField";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import { Warning } from "../../ui/Warning";
import { align, opened, openFault, type AlignSection } from "./alignState";

interface PathEntry {
  kind: "recording" | "path";
  name: string;
}

/** Which scans are laid on which mesh. */
export function FilesPanel() {
  const [paths, setPaths] = useState<PathEntry[]>([]);
  useEffect(() => void call<PathEntry[]>("align.paths").then(setPaths, complain), [entries.value]);
  const section = align.value;
  if (!section) return null;
  const known = new Set(paths.map(({ name }) => name));
  const shown = [...paths, ...section.paths.filter((name) => !known.has(name)).map((name) => ({ kind: "gone" as const, name }))];
  const points = opened.value?.shapes.path_points?.[0];
  const triangles = opened.value?.shapes.indices?.[0];
  return (
    <Panel title="Scan and mesh" testId="align-files">
      <FilePicker
        label="Mesh"
        kinds={["mesh", "scene"]}
        value={section.mesh}
        onChange={(mesh) => change({ mesh, mesh_unit: "" }, "choose a mesh")}
        testId="align-mesh"
      />
      {!isScene(section.mesh) && <MeshUnitField
        value={section.mesh_unit}
        file={section.mesh}
        onChange={(mesh_unit) => void change({ mesh_unit }, "change the mesh's unit").catch(complain)}
        testId="align-unit"
      />}
      <fieldset class="align-paths">
        <legend>Scans, all in one world frame</legend>
        {shown.length === 0 && <p class="empty">The folder contains no recording and no CSV file of a path.</p>}
        {shown.map(({ kind, name }) => (
          <label key={name}>
            <input
              type="checkbox"
              checked={section.paths.includes(name)}
              onChange={(event) => choosePath(section, name, event.currentTarget.checked)}
            />
            <span class="align-name" title={name}>
              {name}
            </span>
            <span class="align-kind">{kind === "gone" ? "missing" : kind}</span>
          </label>
        ))}
      </fieldset>
      <FilePicker
        label="Texture"
        kinds={["texture"]}
        none="The scan's own"
        value={section.textures[0] ?? ""}
        onChange={(name) => edit("/align/textures", name ? [name] : [], "choose the texture")}
        hint="Texture along the path."
      />
      {points !== undefined && triangles !== undefined && (
        <p class="field-hint" data-testid="align-opened">
          {points} points, {triangles} triangles
        </p>
      )}
      {openFault.value && <Warning words={openFault.value} />}
      {((opened.value?.head.problems ?? []) as string[]).map((problem) => (
        <Warning key={problem} words={problem} />
      ))}
    </Panel>
  );
}

/** A scene, to whose mesh scans are added; it has its own unit. */
export const isScene = (mesh: string): boolean => mesh.endsWith(".json");

function choosePath(section: AlignSection, name: string, on: boolean): Promise<void> {
  const paths = on ? [...section.paths, name] : section.paths.filter((other) => other !== name);
  return change({ paths }, on ? "choose a scan" : "leave a scan out").catch(complain);
}

/** Another mesh or scan starts again: poses and picks of the old one mean nothing there. */
function change(part: Partial<AlignSection>, label: string): Promise<void> {
  const { T_mesh_world: _pose, registered: _registered, ...kept } = align.value!;
  return edit("/align", { ...kept, picks: [], ...part }, label);
}
