import { useEffect, useRef, useState } from "preact/hooks";
import type { Block } from "../../net/block";
import { edit, newGesture, section } from "../../state/document";
import { project } from "../../state/project";
import { askShared, isCancelled } from "../../ui/askShared";
import { Button } from "../../ui/Button";
import { FilePicker } from "../../ui/FilePicker";
import { length } from "../../ui/format";
import { useKeys } from "../../ui/keys";
import { MeshInfoPanel } from "../../ui/MeshInfoPanel";
import { MeshUnitField } from "../../ui/MeshUnitField";
import { PageLayout } from "../../ui/PageLayout";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Slider } from "../../ui/Slider";
import { complain } from "../../ui/toast";
import { Warning } from "../../ui/Warning";
import { chequer_mm, indexOf, type PaintSection, type Point, type SceneTextureName, type Show, type Stroke, type StrokeFigures, unitText, warpWords, withObject, withUnitText } from "./painting";
import { type Hover, PaintView } from "./PaintView";
import { StrokePanel } from "./StrokePanel";
import { SwapPanel } from "./SwapPanel";
import { TexturePreview } from "./TexturePreview";
import { WritePanel } from "./WritePanel";
import "./paint.css";

const painting = section<PaintSection>("paint");

const SHOWS: { value: Show; label: string }[] = [
  { value: "textures", label: "Textures" },
  { value: "coordinates", label: "Texture coordinates" },
  { value: "warp", label: "Warp" },
];

/** Draw textures onto a mesh (thesis §5.4). */
export default function PaintPage() {
  const paint = painting.value;
  const [shown, setShown] = useState<{ of: string; block: Block } | null>(null);
  const [show, setShow] = useState<Show>("coordinates");
  const [hover, setHover] = useState<Hover | null>(null);
  const [busy, setBusy] = useState(false);
  const [fault, setFault] = useState("");
  const [brush, setBrush] = useState(false);
  const gesture = useRef("");
  const asked = useRef(0);

  // The former mesh is not shown while another one is read: clicks on it would be points of the new one.
  const of = JSON.stringify([paint.object, paint.unit_m, project.value.mesh_unit]);
  const block = shown?.of === of ? shown.block : null;

  useEffect(() => {
    const mine = ++asked.current;
    if (!paint.object) return setShown(null), setFault(""), setBusy(false);
    const isNewest = () => mine === asked.current;
    setBusy(true);
    if (!block) setFault("");
    askShared<Block>("paint.show", {}, { title: "Painting", wanted: isNewest })
      .then((made) => isNewest() && (setShown({ of, block: made }), setFault("")))
      .catch((error: Error & { hint?: string }) => {
        if (isCancelled(error) || !isNewest()) return;
        setShown(null);
        setFault(`${error.message}. ${error.hint ?? ""}`);
      })
      .finally(() => isNewest() && setBusy(false));
  }, [of, paint.rings, paint.half_width_mm, paint.strokes, paint.swaps]);

  const textures: SceneTextureName[] = block?.head.textures ?? [];
  const figures: StrokeFigures[] = block?.head.strokes ?? [];
  const stroke = paint.strokes[paint.current];
  const unit = unitText(paint);
  const cell_mm = chequer_mm(Math.max(...figures.map((one) => one.path_length_m ?? 0), 0.02));

  const begin = async (texture: string) => {
    const fresh: Stroke = { picks_m: [], texture, index: indexOf(texture, paint.strokes, textures) };
    await edit("/paint", { ...paint, strokes: [...paint.strokes, fresh], current: paint.strokes.length }, "start a stroke");
  };
  const pick = (point: Point) => edit(`/paint/strokes/${paint.current}/picks_m`, [...stroke!.picks_m, point], "add a point").catch(complain);
  const brushed = (points: readonly Point[]) =>
    edit(`/paint/strokes/${paint.current}/picks_m`, [...stroke!.picks_m, ...points], points.length === 1 ? "add a point" : "draw with the brush").catch(complain);
  const dropPick = () =>
    stroke && stroke.picks_m.length > 0 && edit(`/paint/strokes/${paint.current}/picks_m`, stroke.picks_m.slice(0, -1), "remove a point");
  const move = (index: number, point: Point, first: boolean) => {
    if (first) gesture.current = newGesture();
    const picks = stroke!.picks_m.map((old, at) => (at === index ? point : old));
    edit(`/paint/strokes/${paint.current}/picks_m`, picks, "move a point", gesture.current).catch(complain);
  };

  useKeys([
    { key: "b", label: "brush: a drag draws, or rotates the view", run: () => setBrush(!brush) },
    { key: "n", label: "new stroke with the same texture", run: () => stroke && begin(stroke.texture) },
    { key: "backspace", label: "remove the last point", run: dropPick },
    { key: "enter", label: "finish the stroke", run: () => stroke && edit("/paint/current", -1, "finish the stroke") },
    { key: "c", label: "switch between textures, coordinates and warp", run: () => setShow(SHOWS[(SHOWS.findIndex((one) => one.value === show) + 1) % 3]!.value) },
  ]);

  return (
    <PageLayout
      title="Paint"
      side={
        <>
          <Panel title="Mesh or scene to paint">
            <FilePicker label="Mesh or scene" kinds={["mesh", "scene"]} value={paint.object} testId="paint-object"
              onChange={(object) => edit("/paint", withObject(paint, object), `open ${object}`).catch(complain)} />
            {paint.object && !paint.object.endsWith(".json") && (
              <MeshUnitField value={unit} file={paint.object} testId="paint-unit"
                onChange={(text) => edit("/paint", withUnitText(paint, text, project.value.mesh_unit), "change the mesh's unit").catch(complain)} />
            )}
            {fault && <Warning words={fault} />}
            {block && !fault && <p class="field-hint" data-testid="paint-size">{sizeWords(block)}</p>}
          </Panel>
          <MeshInfoPanel file={paint.object} unit={unit} />
          <Panel title="Texture">
            <FilePicker label={stroke ? "Of this stroke" : "Start a stroke with"} kinds={["texture"]} value={stroke?.texture ?? ""} disabled={!paint.object} testId="paint-texture"
              hint={paint.object ? undefined : "Choose a mesh first."}
              onChange={(texture) =>
                (stroke
                  ? edit(`/paint/strokes/${paint.current}`, { ...stroke, texture, index: indexOf(texture, paint.strokes, textures) }, "change the texture")
                  : begin(texture)
                ).catch(complain)} />
            <TexturePreview file={stroke?.texture ?? ""} />
            <Slider label="Half-width of the stroke" value={paint.half_width_mm} low={0} high={20} step={0.1} unit="mm"
              hint={paint.half_width_mm > 0 ? undefined : "0: the triangles under the path and their neighbours"}
              onInput={(value, name) => edit("/paint/half_width_mm", value, "change the width", name).catch(complain)} />
          </Panel>
          <StrokePanel paint={paint} figures={figures} onBegin={begin} />
          <SwapPanel textures={textures} swaps={paint.swaps} />
        </>
      }
      results={<WritePanel paint={paint} figures={figures} />}
    >
      <div class="paint-main">
        <div class="paint-bar">
          <Select label="Show" value={show} options={SHOWS} onChange={(value) => setShow(value as Show)} testId="paint-show" />
          <Button disabled={!stroke} pressed={brush} hint="A drag over the mesh draws the stroke (B); otherwise it rotates the view" onClick={() => setBrush(!brush)} testId="paint-brush">
            Brush
          </Button>
          <Button disabled={!stroke} onClick={() => edit("/paint/current", -1, "finish the stroke")}>
            Finish stroke
          </Button>
        </div>
        <p class="paint-help" role="status" data-testid="paint-help" title={help(paint, busy)}>
          {help(paint, busy)}
        </p>
        <PaintView block={block} strokes={paint.strokes} current={paint.current} show={show} cell_mm={cell_mm} drawing={stroke !== undefined}
          brush={brush} half_width_mm={paint.half_width_mm} onBrush={brushed} onPick={pick} onMove={move} onHover={setHover} />
        <p class="paint-legend" data-testid="paint-legend">
          {legend(show, cell_mm, hover)}
        </p>
      </div>
    </PageLayout>
  );
}

/** How large the mesh is, so that a wrong unit is seen. */
function sizeWords(block: Block): string {
  const size = (block.head.high_m as number[]).map((high, axis) => high - block.head.low_m[axis]);
  const words = `${size.map((one) => length(one, 3)).join(" × ")}, ${block.arrays.texture!.length} triangles.`;
  return Math.max(...size) > 2 ? `${words} Check the unit.` : words;
}

function help(paint: PaintSection, busy: boolean): string {
  if (!paint.object) return "Choose a mesh or a scene of the folder.";
  if (busy) return "Painting …";
  const stroke = paint.strokes[paint.current];
  if (!stroke) return paint.strokes.length > 0 ? "Choose a stroke to change it, or start another." : "Choose a texture to start a stroke.";
  if (stroke.picks_m.length < 2) return `Click on the mesh, or add numbers at the left: ${2 - stroke.picks_m.length} more ${stroke.picks_m.length === 1 ? "point" : "points"} at least.`;
  return "Click to add a point, drag with Brush to add many, drag a point to move it, press Enter to finish.";
}

function legend(show: Show, cell_mm: number, hover: Hover | null): string {
  const what =
    show === "warp"
      ? "Blue: compressed; red: stretched; full colour at 1.25 times and above. Fold colour: folded over."
      : `One square of the checkerboard is ${cell_mm}\u202fmm of the texture.`;
  if (!hover) return what;
  if (hover.texture < 0) return `${what} Here: no texture.`;
  const at = hover.xy_mm ? `, ${hover.xy_mm[0].toFixed(2)}\u202fmm along and ${hover.xy_mm[1].toFixed(2)}\u202fmm across` : "";
  return `${what} Here: texture ${hover.texture}${at}, ${hover.folded ? "folded over" : warpWords(hover.stretch)}.`;
}
