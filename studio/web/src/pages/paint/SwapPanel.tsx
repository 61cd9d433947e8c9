import { edit } from "../../state/document";
import { FilePicker } from "../../ui/FilePicker";
import { Panel } from "../../ui/Panel";
import { complain } from "../../ui/toast";
import type { SceneTextureName } from "./painting";

/** Another texture in the place of one that the scene has; coordinates stay (thesis §5.4). */
export function SwapPanel({ textures, swaps }: { textures: SceneTextureName[]; swaps: Record<string, string> }) {
  return (
    <Panel title="Swap textures" collapsible open={textures.length > 0}>
      {textures.length === 0 && <p class="field-hint">The scene has no textures yet.</p>}
      {textures.map(({ index, name, file }) => (
        <FilePicker
          key={index}
          label={`Texture ${index}: ${name || file}`}
          kinds={["texture"]}
          value={swaps[index] ?? ""}
          none="as painted"
          testId={`paint-swap-${index}`}
          onChange={(chosen) => edit(`/paint/swaps/${index}`, chosen || null, `swap texture ${index}`).catch(complain)}
        />
      ))}
    </Panel>
  );
}
