import { CanvasTexture, Sprite, SpriteMaterial } from "three";

/** A number on a disc, always upright, as high as `size_m`. */
export function numberLabel(text: string, size_m: number, ink: string, disc: string): Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d")!;
  pen.fillStyle = disc;
  pen.beginPath();
  pen.arc(32, 32, 30, 0, 2 * Math.PI);
  pen.fill();
  pen.fillStyle = ink;
  pen.font = `600 ${text.length > 1 ? 30 : 40}px sans-serif`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(text, 32, 35);
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false }));
  sprite.scale.setScalar(size_m);
  sprite.renderOrder = 2;
  return sprite;
}
