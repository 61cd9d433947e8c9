import { useEffect, useState } from "preact/hooks";
import { call, link } from "../../net/connection";
import type { Block } from "../../net/block";
import { attempt } from "../../ui/Button";
import { MeshInfoPanel } from "../../ui/MeshInfoPanel";
import { PageLayout } from "../../ui/PageLayout";
import { DevicePanel } from "./DevicePanel";
import type { TextureHead, TextureIndex } from "./feelAreas";
import { feelSection } from "./feelChoices";
import { FeelPlots } from "./FeelPlots";
import { feelStatus, followFeel } from "./feelStore";
import { FeelView } from "./FeelView";
import { HeightMapsPanel } from "./HeightMapsPanel";
import { RenderingPanel, TexturesPanel } from "./RenderingPanel";
import { ScenePanel } from "./ScenePanel";
import { SoundPanel } from "./SoundPanel";
import { TouchPanel } from "./TouchPanel";
import "./feel.css";

const kDeepest_m = 0.02;
const kDepth_m = 0.004; // about 0.9 N on the default surface, by the default spring

/** A scene, a device, and what is rendered between them. */
export default function FeelPage() {
  useEffect(followFeel, []);
  const [block, setBlock] = useState<Block | null>(null);
  const [depth_m, setDepth] = useState(kDepth_m);
  const [kind, setKind] = useState<"scene" | "maps" | null>(null);
  const status = feelStatus.value;
  const revision = status?.revision ?? null;
  useEffect(() => {
    if (link.value !== "open") return;
    if (revision === null) return setBlock(null);
    let newest = true;
    void attempt(async () => {
      const next = await call<Block>("feel.open");
      if (newest) setBlock(next);
    });
    return () => void (newest = false);
  }, [revision, link.value]);
  const maps = kind ? kind === "maps" : (feelSection.value?.height_maps?.length ?? 0) > 0;
  const isViewer = block?.head.height_maps === true;
  const depth = { depth_m, deepest_m: kDeepest_m, onDepth: setDepth };
  return (
    <PageLayout
      title="Feel"
      side={
        <>
          <ScenePanel maps={maps} onMaps={(on) => setKind(on ? "maps" : "scene")} />
          {!maps && <MeshInfoPanel file={feelSection.value?.scene ?? ""} unit={feelSection.value?.mesh_unit ?? ""} />}
          <DevicePanel {...depth} />
          <RenderingPanel />
          {block && !isViewer && <TexturesPanel textures={block.head.textures as TextureHead[]} indices={block.head.indices as TextureIndex[]} />}
        </>
      }
      results={
        <>
          <TouchPanel />
          <SoundPanel />
          {block && isViewer && <HeightMapsPanel block={block} />}
        </>
      }
      strip={<FeelPlots />}
      stripHeight="30%"
    >
      <FeelView block={block} {...depth} />
      {status?.visited && (
        <p class="viewport-empty" role="status">
          A study is running on the Study page.
        </p>
      )}
      {!block && !status?.visited && (
        <p class="viewport-empty" role="status">
          {status?.loading ? "Reading the scene …" : "Choose a scene, a mesh or height maps at the left. The Paint and Align pages write scenes."}
        </p>
      )}
    </PageLayout>
  );
}
