import { useEffect, useState } from "preact/hooks";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { ConfigForm } from "../../ui/ConfigForm";
import type { ConfigField } from "../../ui/configFields";
import { entries } from "../../ui/entries";
import { cancelJob, jobs } from "../../ui/job";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { complain } from "../../ui/toast";
import { align } from "./alignState";
import type { AreaSection } from "./area";
import { makeArea, makingArea } from "./areaState";

/** Which registered scans become an area, and by which settings. */
export function AreaPanel() {
  const [folders, setFolders] = useState<string[]>([]);
  const [fields, setFields] = useState<ConfigField[]>([]);
  const area: AreaSection = align.value?.area ?? { folder: "", config: {} };
  useEffect(() => void call<string[]>("align.registered").then(setFolders, complain), [entries.value]);
  useEffect(() => void call<ConfigField[]>("align.area_config").then(setFields, complain), [JSON.stringify(area.config)]);
  const job = jobs.value.find(({ title }) => title.startsWith("Area of "));
  const lacks = area.folder ? "" : "Choose a folder that a registration of several scans wrote.";
  const options = [
    { value: "", label: folders.length ? "Choose …" : "None in the folder", disabled: true },
    ...folders,
    ...(area.folder && !folders.includes(area.folder) ? [{ value: area.folder, label: `${area.folder} (not in the folder)` }] : []),
  ];
  const change = (next: AreaSection, label: string) => edit("/align/area", next, label).catch(complain);
  const set = (path: string, text: string | null) => {
    const { [path]: _old, ...others } = area.config;
    return change({ ...area, config: text === null ? others : { ...others, [path]: text } }, text === null ? `reset ${path}` : `set ${path}`);
  };
  return (
    <Panel title="Area of many scans" testId="align-area">
      <Select label="Registered scans" wide value={area.folder} options={options} onChange={(folder) => void change({ ...area, folder }, `make an area of ${folder}`)} testId="align-area-folder" />
      <p class="field-hint">Makes one height map of the strokes over a patch of the mesh. Strokes that cross or are adjacent determine it.</p>
      <div class="buttons">
        <Button kind="primary" onClick={() => makeArea(area)} disabled={lacks !== "" || makingArea.value} hint={lacks || "Finds the patch, unrolls it into a plane, and solves for the heights"} testId="align-area-run">
          Make area
        </Button>
        {makingArea.value && job && <Button onClick={() => cancelJob(job.id)}>Cancel</Button>}
      </div>
      <details>
        <summary>Settings of the area</summary>
        <ConfigForm fields={fields} onChange={(path, text) => void set(path, text)} />
      </details>
    </Panel>
  );
}
