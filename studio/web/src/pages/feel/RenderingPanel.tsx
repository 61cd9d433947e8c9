import { useEffect, useState } from "preact/hooks";
import { call, link } from "../../net/connection";
import { edit } from "../../state/document";
import { attempt, Button } from "../../ui/Button";
import { ConfigForm, type ConfigField } from "../../ui/ConfigForm";
import { Dialog } from "../../ui/Dialog";
import { FilePicker } from "../../ui/FilePicker";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import type { TextureHead, TextureIndex } from "./feelAreas";
import { feelSection, setSetting, settingValue } from "./feelChoices";
import { feelStatus } from "./feelStore";

const QUICK = [
  { path: "render.stiffness_N_per_m", label: "Stiffness where the scene states none", unit: "N/m", low: 50, high: 5000, logarithmic: true },
  { path: "render.friction", label: "Friction where the scene states none", unit: "", low: 0, high: 1.5, logarithmic: false },
  { path: "render.texture.cutoff_cycles_per_mm", label: "Cut-off of textures (0: none)", unit: "cycles/mm", low: 0, high: 20, logarithmic: false },
];

/** Force model and parameters, while touching; all settings in a dialog. */
export function RenderingPanel() {
  const [fields, setFields] = useState<ConfigField[]>([]);
  const [all, setAll] = useState(false);
  const settings = feelSection.value?.settings;
  useEffect(() => {
    if (link.value === "open") void attempt(async () => setFields(await call<ConfigField[]>("feel.fields")));
  }, [link.value, settings]);
  const field = (path: string) => fields.find((one) => one.path === path);
  const model = field("render.texture.model");
  return (
    <Panel title="Rendering" actions={<Button kind="quiet" onClick={() => setAll(true)} testId="feel-settings">All settings</Button>}>
      {model && (
        <Select
          label="Force model"
          wide
          value={String(settings?.[model.path] ?? model.default)}
          options={model.choices ?? []}
          hint="auto: the model of each texture"
          onChange={(value) => attempt(() => setSetting(model.path, value))}
          testId="feel-model"
        />
      )}
      {QUICK.map(({ path, ...rest }) => {
        const found = field(path);
        if (!found) return null;
        const value = Number(settings?.[path] ?? found.default);
        return <Slider key={path} {...rest} value={value} onInput={(next, gesture) => void attempt(() => setSetting(path, next, gesture))} testId={`feel-${path}`} />;
      })}
      <ForceLimit />
      <Dialog title="Settings of the Feel page" open={all} onClose={() => setAll(false)}>
        <p>Settings of “render” apply while you touch, the others at the next start. Limits of the safety layer, ports and drivers are set when the studio starts.</p>
        <ConfigForm fields={fields} onChange={(path, text) => void attempt(() => setSetting(path, text === null ? null : settingValue(text)))} />
      </Dialog>
    </Panel>
  );
}

/** Lower than the start's, never higher. */
function ForceLimit() {
  const most_N = feelStatus.value?.most_force_N ?? 5;
  const value = Math.min(most_N, feelSection.value?.max_force_N ?? most_N);
  return (
    <Slider
      label="Largest force on the hand"
      value={value}
      low={0}
      high={most_N}
      step={most_N / 50}
      unit="N"
      hint={`Can be lowered; at most ${most_N}\u202fN, as set when the studio started.`}
      onInput={(next, gesture) => void attempt(() => edit("/feel/max_force_N", next, "largest force", gesture))}
      testId="feel-max-force"
    />
  );
}

/** The textures of the scene, and others instead of them. */
export function TexturesPanel({ textures, indices }: { textures: TextureHead[]; indices: TextureIndex[] }) {
  const chosen = feelSection.value?.textures ?? {};
  return (
    <Panel title="Textures" collapsible>
      {indices.length === 0 && <p class="empty">The scene has no textures; its surface is smooth.</p>}
      {indices.map(({ index, file, texture, object }) => (
        <div key={`${object} ${index}`} class="feel-texture">
          <p>
            <strong>{index}</strong> {textures[texture]?.name || file} <span class="field-hint">({feelStatus.value?.models[texture]})</span>
          </p>
          {object === 0 && (
            <FilePicker
              label="Replace by"
              kinds={["texture"]}
              value={chosen[index] ?? ""}
              none="The scene's texture"
              onChange={(name) => attempt(() => edit(`/feel/textures/${index}`, name || null, name ? `texture ${index}: ${name}` : `texture ${index}: the scene's`))}
              testId={`feel-texture-${index}`}
            />
          )}
        </div>
      ))}
    </Panel>
  );
}
