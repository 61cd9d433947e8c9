// What a view was fitted to, as long as it is there.
import { Box3, type Object3D } from "three";

export interface Fitted {
  /** The object, or the box alone; null: an object that was removed. */
  what: Object3D | Box3 | null;
  box: Box3;
}

/**
 * The box that a view with another shape fits again: of the whole content as it is now, of a part as it was fitted. Null
 * once that part is gone; another part of the same size in its position counts as the same.
 */
export function boxOfFitted({ what, box }: Fitted, content: Object3D): Box3 | null {
  if (what && "isBox3" in what) return box;
  if (what === content) return shownBox(content);
  if (what && rootOf(what) === rootOf(content)) return box;
  return content.children.some((part) => new Box3().setFromObject(part).equals(box)) ? box : null;
}

function shownBox(content: Object3D): Box3 | null {
  const box = new Box3().setFromObject(content);
  return box.isEmpty() ? null : box;
}

function rootOf(object: Object3D): Object3D {
  let root = object;
  while (root.parent) root = root.parent;
  return root;
}
