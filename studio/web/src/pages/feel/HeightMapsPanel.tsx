import { useEffect, useRef } from "preact/hooks";
import type { Block } from "../../net/block";
import { length } from "../../ui/format";
import { Panel } from "../../ui/Panel";
import { greys, type TextureHead } from "./feelAreas";

/** The images that are rendered, as they are laid: black the lowest, white the highest (thesis Fig. 38). */
export function HeightMapsPanel({ block }: { block: Block }) {
  const heads = block.head.textures as TextureHead[];
  return (
    <Panel title="Height maps" collapsible>
      <ul class="feel-maps">
        {heads.map((head, index) => (
          <li key={index}>
            <HeightImage block={block} index={index} head={head} />
            <span>{head.name || `Tile ${index + 1}`}</span>
          </li>
        ))}
      </ul>
    </Panel>
  );
}

function HeightImage({ block, index, head }: { block: Block; index: number; head: TextureHead }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const heights = block.arrays[`height_${index}`];
    const [rows, columns] = block.shapes[`height_${index}`] ?? [];
    if (!heights || !rows || !columns || !canvas.current) return;
    canvas.current.width = columns;
    canvas.current.height = rows;
    const pen = canvas.current.getContext("2d")!;
    const picture = pen.createImageData(columns, rows);
    greys(heights, head.highest_m).forEach((grey, at) => picture.data.set([grey, grey, grey, 255], 4 * at));
    pen.putImageData(picture, 0, 0);
  }, [block, index]);
  return <canvas ref={canvas} role="img" aria-label={`Heights of ${head.name || `tile ${index + 1}`}, up to ${length(head.highest_m, 3)}`} />;
}
