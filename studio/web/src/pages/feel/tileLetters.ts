// Letters over the tiles of a trial, where the picture has them.
import { Vector3 } from "three";
import type { Block } from "../../net/block";
import type { View } from "../../view3d/View";

/** Of each textured area of the first object: the middle of its upper edge as it is seen from above, in metres. */
export function tileTops(block: Block): Vector3[] {
  const vertices = block.arrays.vertices_0!;
  const triangles = block.arrays.triangles_0!;
  const texture = block.arrays.texture_0!;
  const heads = block.head.textures as unknown[];
  return heads.map((_, index) => {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = new Vector3(-Infinity, -Infinity, -Infinity);
    const at = new Vector3();
    for (let corner = 0; corner < triangles.length; ++corner) {
      if (texture[Math.floor(corner / 3)] !== index) continue;
      at.fromArray(vertices, 3 * triangles[corner]!);
      low.min(at);
      high.max(at);
    }
    return new Vector3((low.x + high.x) / 2, high.y, high.z);
  });
}

/** Puts each child of `letters` at its position, within the picture. */
export function placeLetters(letters: HTMLElement | null, view: View, tops_m: readonly Vector3[]): void {
  for (const [index, letter] of [...(letters?.children ?? [])].entries()) {
    const top_m = tops_m[index];
    if (!(letter instanceof HTMLElement) || !top_m) continue;
    view.camera.updateMatrixWorld();
    const at = top_m.clone().project(view.camera);
    letter.style.left = `${((at.x + 1) / 2) * view.canvas.clientWidth}px`;
    letter.style.top = `${Math.max(letter.offsetHeight, ((1 - at.y) / 2) * view.canvas.clientHeight)}px`;
  }
}
