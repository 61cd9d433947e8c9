import { useEffect, useRef } from "preact/hooks";
import type { Block } from "../../net/block";
import { themeColour } from "../../plot/colours";
import { fixed } from "../../ui/format";
import { image, state } from "./stream";

interface Tag {
  id: number;
  corners_px: number[];
}

/** What the tracker's camera sees, with the tags that were found. */
export function CameraImage() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const block = state.value?.open ? image.value : null;
  const tags: Tag[] = block?.head.tags ?? [];
  useEffect(() => {
    if (block && canvas.current) draw(canvas.current, block, tags);
  }, [block]);
  const found = tags.map((tag) => tag.id).join(", ");
  return (
    <figure class="scan-camera" data-testid="scan-camera" data-tags={tags.length}>
      {block ? (
        <canvas ref={canvas} role="img" aria-label={tags.length ? `The camera's image with the tags ${found}` : "The camera's image; no tag is found"} />
      ) : (
        <p class="empty">{state.value?.open && !state.value.source?.camera ? "This source has no camera." : "Open a source to see the camera's image."}</p>
      )}
      {block && (
        <figcaption>
          {tags.length ? `tags ${found}` : "no tag found"}
          {block.head.reprojection_px != null && ` · ${fixed(block.head.reprojection_px, 2)} px`}
          {block.head.ambiguous && " · ambiguous"}
        </figcaption>
      )}
    </figure>
  );
}

function draw(canvas: HTMLCanvasElement, block: Block, tags: readonly Tag[]): void {
  const grey = block.arrays.pixels!;
  const [height, width] = block.shapes.pixels as [number, number];
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context) return;
  const picture = context.createImageData(width, height);
  const words = new Uint32Array(picture.data.buffer);
  for (let pixel = 0; pixel < words.length; ++pixel) words[pixel] = 0xff000000 | (grey[pixel]! * 0x010101);
  context.putImageData(picture, 0, 0);
  context.lineWidth = 2;
  context.font = `600 15px ${themeColour("--font")}`;
  for (const { id, corners_px: at } of tags) {
    const box = () => {
      context.beginPath();
      // Pixel centres have whole coordinates; a canvas has them at a half.
      for (let corner = 0; corner < 4; ++corner) context.lineTo(at[2 * corner]! + 0.5, at[2 * corner + 1]! + 0.5);
      context.closePath();
    };
    // A light line on a dark one is seen on any image.
    context.strokeStyle = "#000000";
    context.lineWidth = 5;
    box();
    context.stroke();
    context.strokeStyle = "#7cf0a8";
    context.lineWidth = 2;
    context.stroke();
    const x = (at[0]! + at[2]! + at[4]! + at[6]!) / 4 - 6;
    const y = (at[1]! + at[3]! + at[5]! + at[7]!) / 4 + 6;
    context.lineWidth = 4;
    context.strokeStyle = "#000000";
    context.strokeText(String(id), x, y);
    context.fillStyle = "#7cf0a8";
    context.fillText(String(id), x, y);
  }
}
