import { useEffect, useRef, useState } from "preact/hooks";
import type { Block } from "../../net/block";
import { call } from "../../net/connection";
import { length } from "../../ui/format";

/** A texture's heights over a square, dark is deep. */
export function TexturePreview({ file }: { file: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [words, setWords] = useState("");

  useEffect(() => {
    let gone = false;
    setWords("");
    if (!file) return;
    call<Block>("paint.texture", { file }).then(
      (block) => !gone && setWords(draw(canvas.current, block)),
      (error: Error) => !gone && setWords(error.message),
    );
    return () => void (gone = true);
  }, [file]);

  if (!file) return null;
  return (
    <figure class="paint-preview">
      <canvas ref={canvas} width={64} height={64} role="img" aria-label={`Heights of ${file}. ${words}`} />
      <figcaption>{words}</figcaption>
    </figure>
  );
}

/** Draws the heights; states how large they are. */
function draw(canvas: HTMLCanvasElement | null, block: Block): string {
  const heights = block.arrays.height_m;
  const context = canvas?.getContext("2d");
  if (!canvas || !context) return "";
  if (!heights) {
    context.clearRect(0, 0, canvas.width, canvas.height);
    return "A force over time, not a height.";
  }
  let low = Infinity;
  let high = -Infinity;
  for (const height of heights) {
    low = Math.min(low, height);
    high = Math.max(high, height);
  }
  const side = Math.sqrt(heights.length);
  const image = context.createImageData(side, side);
  heights.forEach((height, index) => {
    const grey = high > low ? Math.round((255 * (height - low)) / (high - low)) : 128;
    image.data.set([grey, grey, grey, 255], 4 * index);
  });
  context.putImageData(image, 0, 0);
  return `${length(block.head.side_m, 3)} wide, ${length(high - low, 3)} from lowest to highest`;
}
