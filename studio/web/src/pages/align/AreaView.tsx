import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { dark } from "../../app/settings";
import { cssColour } from "../../measured/pathColours";
import type { Block } from "../../net/block";
import { millimetres, number, percent } from "../../ui/format";
import { Select } from "../../ui/Select";
import type { View } from "../../view3d/View";
import { project } from "../../state/project";
import { Viewport } from "../../view3d/Viewport";
import { align } from "./alignState";
import { areaKey, holes, mapOf, mapPixels, mapRange, mapValues_um, type AreaMap, type MapQuantity } from "./area";
import { AreaScene } from "./AreaScene";
import { areaFault, madeArea, makingArea } from "./areaState";

const kStops = 9;

/** The height map of the area, or its σ: flat, and on the mesh. */
export function AreaView() {
  const made = madeArea.value;
  if (makingArea.value) return <p class="empty">The area is being made …</p>;
  if (areaFault.value) return <p class="empty" role="alert">The area could not be made: {areaFault.value}</p>;
  if (!made) {
    return (
      <div class="page-empty">
        <h2>No area yet</h2>
        <p>Register several scans that cross or are adjacent on a patch of the mesh, and write the result. Then choose its folder at the left.</p>
      </div>
    );
  }
  const map = mapOf(made.block);
  return (
    <>
      {made.key !== areaKey(align.value?.area) && <p class="measured-note" role="status">Scans or settings were changed since. Make the area again.</p>}
      {map ? <Shown block={made.block} map={map} /> : <p class="empty">No map could be made. The verdicts at the right state why.</p>}
    </>
  );
}

function Shown({ block, map }: { block: Block; map: AreaMap }) {
  const [what, setWhat] = useState<MapQuantity>("height");
  const canvas = useRef<HTMLCanvasElement>(null);
  const scene = useRef<AreaScene | null>(null);
  const [view, setView] = useState<View | null>(null);
  const values = useMemo(() => mapValues_um(block, what), [block, what]);
  const range = useMemo(() => mapRange(values, what), [values, what]);
  const [width_mm, height_mm] = [map.columns, map.rows].map((count) => 1e3 * map.spacing_m * count) as [number, number];

  useEffect(() => {
    const target = canvas.current;
    if (!target) return;
    target.width = map.columns;
    target.height = map.rows;
    const pen = target.getContext("2d")!;
    if (range) pen.putImageData(new ImageData(mapPixels(values, range) as Uint8ClampedArray<ArrayBuffer>, map.columns, map.rows), 0, 0);
    scene.current?.repaint();
  }, [block, values, range]);
  useEffect(() => {
    if (!view || !canvas.current) return;
    const made = new AreaScene(view, block, canvas.current);
    scene.current = made;
    made.fit();
    return () => {
      scene.current = null;
      made.destroy();
    };
  }, [view, block, dark.value]);

  return (
    <div class="align-area">
      <div class="measured-bar">
        <Select
          label="Colour"
          value={what}
          options={[
            { value: "height", label: "Height" },
            { value: "sigma", label: "σ of the height" },
          ]}
          onChange={(value) => setWhat(value as MapQuantity)}
          testId="align-area-colour"
        />
        {range && (
          <span class="measured-key" data-testid="align-area-key">
            {number(range.low, 3)}
            <span class="measured-key-bar" style={{ background: `linear-gradient(to right, ${Array.from({ length: kStops }, (_, at) => cssColour(at / (kStops - 1))).join(", ")})` }} />
            {number(range.high, 3)}
            {"\u202f"}µm
          </span>
        )}
        <span class="measured-key">
          <span class="align-hole" />
          no heights: {percent(holes(block.arrays.supported!), 2)} of the map
        </span>
      </div>
      <div class="align-area-pictures">
        <figure class="align-map">
          <canvas
            ref={canvas}
            role="img"
            aria-label={`${what === "height" ? "Heights" : "Standard deviations"} of the area, ${number(width_mm, 3)} by ${number(height_mm, 3)} mm`}
            style={{ aspectRatio: `${map.columns} / ${map.rows}` }}
            data-testid="align-area-map"
          />
          <figcaption>
            {millimetres(1e-3 * width_mm, 3)} by {millimetres(1e-3 * height_mm, 3)}, as seen from outside; to the right is x, the strokes' common direction.
            {map.every > 1 && ` One of every ${map.every} points per side is drawn.`}
          </figcaption>
        </figure>
        <Viewport
          label="The mesh with the map on the patch of the strokes"
          up={project.value.up}
          testId="align-area-view"
          onReady={(made) => {
            setView(made);
            return () => setView(null);
          }}
        />
      </div>
    </div>
  );
}
